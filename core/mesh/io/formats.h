// The reader and the writer of each format, for model.cpp.  Internal.
#pragma once

#include <string_view>

#include "core/mesh/io/model.h"

namespace loopcheck::core {

Result<Model> parse_obj(std::string_view bytes);
Result<Model> parse_off(std::string_view bytes);
Result<Model> parse_ply(std::string_view bytes);
Result<Model> parse_stl(std::string_view bytes);

// The writers require a model whose faces and tags name things that exist and whose numbers are finite:
// `format_model` checks it.
Written format_obj(const Model& model);
Written format_off(const Model& model);
Written format_ply(const Model& model, Encoding encoding);
Result<Written> format_stl(const Model& model);

}  // namespace loopcheck::core
