// Golden tests in a program without a test framework:
//
//   int main(int argc, char** argv)
//   {
//       return relief::goldenMain(argc, argv, {.goldens = "goldens"}, [] { relief::expectGolden("lens", draw()); });
//   }
#pragma once

#include "relief/check/test_program.h"

namespace relief {

namespace detail {

inline int& failedGoldens()
{
    static int count = 0;
    return count;
}

inline bool reportGolden(const Expected<void>& result)
{
    if (result) return true;
    ++failedGoldens();
    std::fprintf(stderr, "%s\n", result.error().message.c_str());
    return false;
}

}  // namespace detail

// Holds a target, or a picture (ImageFile), to the golden of that name. Where it does not meet it, prints what differs
// and returns false; main() returns 1 then.
template <class Picture>
bool expectGolden(const std::string& name, const Picture& picture, const Tolerance& tolerance = {})
{
    return detail::reportGolden(detail::checkInTest(picture, name, tolerance, {}));
}

// The same, and tells how the first differing pixel of the frame came about.
inline bool expectGolden(const std::string& name, const Framebuffer& target, Frame& frame,
                         const Tolerance& tolerance = {})
{
    return detail::reportGolden(detail::checkInTest(target, name, tolerance, detail::tellerOf(frame)));
}

// What main() returns. Takes --update and no other argument. The tests are a function without parameters.
template <class Tests>
int goldenMain(int argc, char** argv, GoldenOptions options, const Tests& tests)
{
    return detail::runGoldenTests(argc, argv, std::move(options), [&](int count, char** words) {
        if (count > 1) {
            std::fprintf(stderr, "%s: does not understand \"%s\"; it takes --update, or nothing\n", words[0], words[1]);
            return 2;
        }
        tests();
        detail::goldenTests().isWhole = true;
        if (detail::failedGoldens() > 0) std::fprintf(stderr, "%d golden tests failed\n", detail::failedGoldens());
        return detail::failedGoldens() > 0 ? 1 : 0;
    });
}

}  // namespace relief
