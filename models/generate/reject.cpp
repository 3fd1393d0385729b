// The files to refuse. The texts are literal, since a broken mesh cannot be made from a `Mesh`.
#include "models/generate/reject.h"

namespace loopcheck::models {
namespace {

// A sound tetrahedron, as a place for one mistake more.
const std::string kPoints = "v 0.3 0.2 1.1\nv 1.6 0.4 0.7\nv 0.6 1.9 0.8\nv 0.9 0.7 2.4\n";
const std::string kFaces = "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
const std::string kTetrahedron = kPoints + kFaces;

// The same points in the way of OFF and PLY.
const std::string kBarePoints = "0.3 0.2 1.1\n1.6 0.4 0.7\n0.6 1.9 0.8\n0.9 0.7 2.4\n";
const std::string kBareFaces = "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

struct Fault {
    std::string code;
    std::string word;
    std::string reason;
    std::string body;
};

/// "code-word.extension", or "code.extension" without a word.
std::string file_name(const Fault& fault, const std::string& extension) {
    return fault.code + (fault.word.empty() ? "" : "-" + fault.word) + extension;
}

std::string remark(const Fault& fault) {
    return "reject: " + fault.code + ": " + fault.reason + "\n";
}

Reject obj(const Fault& fault) {
    return {file_name(fault, ".obj"), fault.code, fault.reason, "# " + remark(fault) + fault.body};
}

Reject points(const Fault& fault) {
    return {file_name(fault, ".txt"), fault.code, fault.reason, "# " + remark(fault) + fault.body};
}

/// The body starts with the line of counts.
Reject off(const Fault& fault) {
    return {file_name(fault, ".off"), fault.code, fault.reason, "OFF\n# " + remark(fault) + fault.body};
}

Reject ply(const Fault& fault, const std::string& vertex_count, const std::string& face_count) {
    const std::string head = "ply\nformat ascii 1.0\ncomment " + remark(fault) + "element vertex " +
                             vertex_count + "\nproperty double x\nproperty double y\nproperty double z\n" +
                             "element face " + face_count +
                             "\nproperty list uchar int vertex_indices\nend_header\n";
    return {file_name(fault, ".ply"), fault.code, fault.reason, head + fault.body};
}

std::vector<Reject> syntax() {
    return {
        obj({"bad-syntax", "two-coordinates", "a vertex of two coordinates",
             "v 0.3 0.2\nv 1.6 0.4 0.7\nv 0.6 1.9 0.8\nv 0.9 0.7 2.4\n" + kFaces}),
        obj({"bad-syntax", "word", "a word where a coordinate belongs",
             "v 0.3 0.2 near\nv 1.6 0.4 0.7\nv 0.6 1.9 0.8\nv 0.9 0.7 2.4\n" + kFaces}),
        obj({"bad-syntax", "face", "a word where a vertex index belongs",
             kPoints + "f 1 3 two\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"}),
        obj({"bad-syntax", "tag", "a crease that names one vertex only",
             kTetrahedron + "t crease 2/1/0 0\n"}),
        off({"bad-syntax", "truncated-vertices", "the vertex list ends before its count",
             "4 4 6\n0.3 0.2 1.1\n1.6 0.4 0.7\n"}),
        off({"bad-syntax", "face-count", "one face less than the counts say",
             "4 5 6\n" + kBarePoints + kBareFaces}),
        off({"bad-syntax", "counts", "the line of counts is a word", "four\n" + kBarePoints + kBareFaces}),
        ply({"bad-syntax", "truncated-faces", "the face list ends before its count",
             kBarePoints + "3 0 2 1\n3 0 1 3\n"},
            "4", "4"),
        ply({"bad-syntax", "count", "the vertex count is negative", kBarePoints + kBareFaces}, "-4", "4"),
    };
}

std::vector<Reject> faces() {
    return {
        obj({"not-a-triangle", "quad", "a face of four vertices", kPoints + "f 1 2 3 4\n"}),
        obj({"not-a-triangle", "pentagon", "a face of five vertices",
             kPoints + "v 0.1 1.2 1.7\nf 1 2 3 4 5\n"}),
        off({"not-a-triangle", "quad", "a face of four vertices", "4 1 4\n" + kBarePoints + "4 0 1 2 3\n"}),
        ply({"not-a-triangle", "quad", "a face of four vertices", kBarePoints + "4 0 1 2 3\n"}, "4", "1"),
        obj({"index-out-of-range", "high", "a face of vertex 5 of 4",
             kPoints + "f 1 3 2\nf 1 2 5\nf 1 4 3\nf 2 3 4\n"}),
        obj({"index-out-of-range", "zero", "a face of vertex 0, and OBJ counts from 1",
             kPoints + "f 1 3 2\nf 1 2 0\nf 1 4 3\nf 2 3 4\n"}),
        obj({"index-out-of-range", "negative", "a face of vertex -5, before the first of 4",
             kPoints + "f 1 3 2\nf 1 2 -5\nf 1 4 3\nf 2 3 4\n"}),
        obj({"index-out-of-range", "corner", "a corner tag on vertex 4, and tags count 4 vertices from 0",
             kTetrahedron + "t corner 1/1/0 4 2.5\n"}),
        off({"index-out-of-range", "high", "a face of vertex 4, and OFF counts 4 vertices from 0",
             "4 4 6\n" + kBarePoints + "3 0 2 1\n3 0 1 4\n3 0 3 2\n3 1 2 3\n"}),
        ply({"index-out-of-range", "negative", "a face of vertex -1",
             kBarePoints + "3 0 2 1\n3 0 1 -1\n3 0 3 2\n3 1 2 3\n"},
            "4", "4"),
        obj({"repeated-vertex", "", "a face that names vertex 2 twice",
             kPoints + "f 1 3 2\nf 2 2 4\nf 1 4 3\nf 2 3 4\n"}),
        obj({"duplicate-face", "", "a face again, from another first vertex",
             kPoints + "f 1 2 3\nf 2 3 1\n"}),
        obj({"empty-mesh", "no-faces", "vertices and no face", kPoints}),
        obj({"empty-mesh", "only-a-comment", "nothing at all", ""}),
        off({"empty-mesh", "no-faces", "vertices and no face", "4 0 0\n" + kBarePoints}),
    };
}

std::vector<Reject> numbers() {
    const std::string others = "v 1.6 0.4 0.7\nv 0.6 1.9 0.8\nv 0.9 0.7 2.4\n" + kFaces;
    return {
        obj({"not-finite", "nan", "a coordinate that is not a number", "v 0.3 nan 1.1\n" + others}),
        obj({"not-finite", "inf", "an infinite coordinate", "v 0.3 0.2 -inf\n" + others}),
        obj({"not-finite", "overflow", "a coordinate beyond the range of double",
             "v 1e999 0.2 1.1\n" + others}),
        ply({"not-finite", "nan", "a coordinate that is not a number",
             "0.3 0.2 nan\n1.6 0.4 0.7\n0.6 1.9 0.8\n0.9 0.7 2.4\n" + kBareFaces},
            "4", "4"),
    };
}

std::vector<Reject> tags() {
    return {
        obj({"bad-sharpness", "negative", "an edge of sharpness -1",
             kTetrahedron + "t crease 2/1/0 0 1 -1\n"}),
        obj({"bad-sharpness", "nan", "a vertex whose sharpness is not a number",
             kTetrahedron + "t corner 1/1/0 2 nan\n"}),
        obj({"no-such-edge", "", "a crease between two vertices that no edge joins",
             "v 0.3 0.2 1.1\nv 1.6 0.4 0.7\nv 1.9 1.9 0.8\nv 0.1 1.7 1.4\nf 1 2 3\nf 1 3 4\n"
             "t crease 2/1/0 1 3 2.5\n"}),
        obj({"hole-out-of-range", "high", "a hole tag on face 4, and tags count 4 faces from 0",
             kTetrahedron + "t hole 1/0/0 4\n"}),
        obj({"hole-out-of-range", "negative", "a hole tag on face -1", kTetrahedron + "t hole 1/0/0 -1\n"}),
    };
}

std::vector<Reject> manifolds() {
    const std::string five_points = kPoints + "v 2.2 1.8 2.9\n";
    return {
        obj({"non-manifold-edge", "", "an edge of three faces", five_points + "f 1 2 3\nf 2 1 4\nf 1 2 5\n"}),
        obj({"non-manifold-vertex", "bow-tie", "two triangles that share a vertex and no edge",
             five_points + "f 1 2 3\nf 1 4 5\n"}),
        obj({"non-manifold-vertex", "closed-fans", "two tetrahedra that share a vertex and no edge",
             kPoints + "v 0.5 -0.8 0.4\nv -0.9 0.1 0.6\nv 0.2 -0.3 -0.9\n" + kFaces +
                 "f 1 6 5\nf 1 5 7\nf 1 7 6\nf 5 6 7\n"}),
        obj({"inconsistent-winding", "", "two neighbours that run along their edge in the same direction",
             kPoints + "f 1 2 3\nf 1 2 4\n"}),
        obj({"inconsistent-winding", "moebius", "a Moebius strip: no consistent winding exists",
             five_points + "f 1 2 3\nf 2 4 3\nf 3 4 5\nf 4 1 5\nf 5 1 2\n"}),
    };
}

std::vector<Reject> control_points() {
    const std::string good = "0.2 0.1\n1.4 0.6\n2.9 1.3\n";
    return {
        points({"bad-syntax", "word-between-points", "a word where a coordinate belongs", good + "1.4 x\n"}),
        points({"bad-syntax", "one-coordinate", "a point of one coordinate", good + "1.4\n"}),
        points({"bad-syntax", "four-coordinates", "a point of four coordinates", "1 2 3 4\n" + good}),
        points({"bad-syntax", "mixed-dimensions", "points of two coordinates, then one of three",
                good + "1.4 0.6 0.3\n"}),
        points({"bad-syntax", "mixed-separators", "commas and semicolons in one line",
                "0.2,0.1,0.5\n1.4,0.6;0.5\n"}),
        points({"bad-syntax", "empty-field", "nothing between two commas", "0.2,,0.1\n1.4,0.6,0.5\n"}),
        points({"not-finite", "point", "a coordinate that is not a number", good + "nan 0.6\n"}),
        points({"not-finite", "too-large", "a coordinate that cannot be summed", good + "1e308 0.6\n"}),
        points({"too-few-points", "", "one point, and no curve", "0.2 0.1\n"}),
        points({"too-few-points", "none", "nothing but this comment", ""}),
    };
}

}  // namespace

std::vector<Reject> rejects() {
    std::vector<Reject> all;
    for (const auto& subject : {syntax, faces, numbers, tags, manifolds, control_points}) {
        for (Reject& reject : subject()) all.push_back(std::move(reject));
    }
    return all;
}

}  // namespace loopcheck::models
