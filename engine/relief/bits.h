// The bits of a value as another type: std::bit_cast, which emscripten's C++ library does not have yet.
#pragma once

namespace relief {

template <class To, class From>
constexpr To bitCast(const From& from)
{
    static_assert(sizeof(To) == sizeof(From));
    return __builtin_bit_cast(To, from);
}

}  // namespace relief
