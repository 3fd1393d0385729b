// What a test asks of a Result.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "core/mesh/error.h"

namespace loopcheck::tests {

/// The value.  Where there is none the test fails with the error, and a default value stands in.
template <class T>
T value_of(core::Result<T> result) {
    if (result) return std::move(*result);
    ADD_FAILURE() << core::to_string(result.error());
    return T{};
}

/// The error.  Where there is none the test fails.
template <class T>
core::Error error_of(const core::Result<T>& result) {
    if (!result) return result.error();
    ADD_FAILURE() << "There is a value where an error was expected.";
    return {core::ErrorCode::SubjectFailed, "", {}};
}

/// For comparing with the place of an error.
inline core::Place line(std::int64_t number) {
    return {core::Place::Kind::Line, number};
}
inline constexpr core::Place kNoPlace{};

inline bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace loopcheck::tests
