// The lines of OBJ files in which OpenSubdiv keeps what is not geometry: sharpness, holes, options. Internal.
//
//     t crease 2/1/0 4 5 1.5              ints: pairs of vertices; floats: a sharpness for all or one a pair
//     t corner 1/1/0 4 2.5                ints: vertices; floats: a sharpness for all or one a vertex
//     t hole 2/0/0 7 8                    ints: faces
//     t interpolateboundary 1/0/0 1       0 none, 1 edge-and-corner, 2 edge-only
//     t creasemethod 0/0/1 chaikin        normal (or uniform) and chaikin
//
// After the name stand the numbers of integers, floats and strings that follow.  Unlike faces, tags count
// from 0.
#pragma once

#include <string>
#include <vector>

#include "core/mesh/io/model.h"
#include "core/mesh/io/model_builder.h"
#include "core/mesh/io/text_reader.h"

namespace loopcheck::core {

class ObjTags {
  public:
    /// Reads what follows the keyword t.  Tags of other names are counted and skipped.
    Result<void> read(Words words, Spot spot, Model& model);

    /// Every tag names a vertex or face that there is.  For the end of the file, when all of them are known.
    Result<void> check(const MeshData& data) const;

    /// Adds a warning for each name that was skipped.
    void warn(std::vector<std::string>& warnings) const { unknown_.warn("tag", warnings); }

  private:
    std::vector<long long> crease_lines_;  ///< one for each crease of the model, and so on
    std::vector<long long> corner_lines_;
    std::vector<long long> hole_lines_;
    NameTally unknown_;
};

/// Appends the tag lines of a model: one a crease, corner and hole, because OpenSubdiv's own reader takes no
/// line of more than 255 characters.
void append_obj_tags(std::string& text, const Model& model);

}  // namespace loopcheck::core
