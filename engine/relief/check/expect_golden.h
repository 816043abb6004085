// The checks that a test calls, the same for every framework: doctest.h, gtest.h and catch2.h define
// detail::reportGolden(), which tells the framework, and then include this.
#pragma once

#include <string>

#include "relief/check/test_program.h"

namespace relief {

namespace detail {
bool reportGolden(const Expected<void>& result, const char* file, int line);  // the framework's; gives the result
}

// Holds a target, or a picture (ImageFile), to the golden of this test; of several in one test each has a part's name.
template <class Picture>
bool expectGolden(const Picture& picture, const Tolerance& tolerance = {}, const char* file = __builtin_FILE(),
                  int line = __builtin_LINE())
{
    return detail::reportGolden(detail::checkInTest(picture, "", tolerance, {}), file, line);
}

template <class Picture>
bool expectGolden(const Picture& picture, const std::string& part, const Tolerance& tolerance = {},
                  const char* file = __builtin_FILE(), int line = __builtin_LINE())
{
    return detail::reportGolden(detail::checkInTest(picture, part, tolerance, {}), file, line);
}

// The same, and tells how the first differing pixel of the frame came about.
inline bool expectGolden(const Framebuffer& target, Frame& frame, const Tolerance& tolerance = {},
                         const char* file = __builtin_FILE(), int line = __builtin_LINE())
{
    return detail::reportGolden(detail::checkInTest(target, "", tolerance, detail::tellerOf(frame)), file, line);
}

}  // namespace relief
