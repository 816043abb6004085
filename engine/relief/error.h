// What every function of the engine that can fail returns: a value, or one line that names the file, the field and the
// remedy. The engine never prints, exits or throws; its callers decide what to do with the line. Running out
// of memory is such an error where the caller chose a size (a target, a file); elsewhere std::bad_alloc ends the
// program.
#pragma once

#include <string>
#include <utility>

#include <tl/expected.hpp>

namespace relief {

struct Error
{
    std::string message;  // one line, no full stop, no newline
};

template <class T>
using Expected = tl::expected<T, Error>;

inline tl::unexpected<Error> fail(std::string message)
{
    return tl::unexpected<Error>(Error{std::move(message)});
}

}  // namespace relief
