// What is measured: a task on a mesh, and those who do it.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/mesh/error.h"
#include "core/mesh/triangle_mesh.h"

namespace loopcheck::bench {

/// A subject at work on one mesh.
struct Run {
    std::function<void()> work;                 ///< what is timed
    std::function<void()> clear;                ///< forgets the result; buffers for the next are kept
    std::function<std::string()> disagreement;  ///< what is wrong with the result; empty where nothing is
};

/// Moves a value to where the functions of a run can share it.
template <class T>
std::shared_ptr<T> shared(T value) {
    return std::make_shared<T>(std::move(value));
}

struct Subject {
    std::string name;
    int threads = 1;
    double bytes_per_item;  ///< that it needs at most: left out where there are less
    std::function<core::Result<Run>(const core::TriangleMesh&)> make;
};

struct Case {
    std::string task;
    core::Precision precision;
    const core::TriangleMesh& (*mesh)(int size);
    int size;  ///< of the control mesh: it has 20 4^size faces
    int level;
    double items;                   ///< vertices or samples: costs are per item
    double written;                 ///< bytes an item that nobody can do without writing
    std::vector<Subject> subjects;  ///< the first is what the others are compared with
};

inline const core::TriangleMesh& mesh_of(const Case& c) {
    return c.mesh(c.size);
}

/// "total/double/20480/4/ours/2".
std::string name_of(const Case& c, const Subject& subject);

}  // namespace loopcheck::bench
