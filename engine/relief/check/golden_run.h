// One run of a program's golden tests: pictures are compared with the goldens of a folder, failures leave pictures and
// records behind, `--update` rewrites the goldens that failed, and a golden that no test draws fails at the end.
//
// The frameworks' adapters hold one of these: doctest.h, gtest.h, catch2.h, and main.h for a program without any.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "relief/check/golden.h"
#include "relief/pipeline/frame.h"

namespace relief {

struct GoldenOptions
{
    std::string goldens;                       // the folder of the goldens: this program's, and nobody else's
    std::string failures = "golden_failures";  // what failing checks leave, and a record of every check: likewise its
                                               // own, since records of other checks are removed
    bool update = false;                       // the flag --update: see takeUpdateFlag()
};

// Takes the word --update out of a program's arguments, and says whether it was there. An error where it was, and the
// environment has CI set, to whatever: goldens are not rewritten where nobody looks at them.
Expected<bool> takeUpdateFlag(int& argc, char** argv);
Expected<void> mayUpdate();  // that error alone

// The name of a golden for a test's name: "Shadows: soft / edges" is "Shadows__soft_/_edges", in a folder. Letters,
// digits, '.', '-', '_' and what is not ASCII stay; '/' makes folders.
std::string goldenNameOf(const std::string& test);

class GoldenRun
{
public:
    explicit GoldenRun(GoldenOptions options);

    // Holds a picture to GOLDENS/NAME.png, one of floats to NAME.pfm. An error of several lines where it does not meet
    // it, which names both pictures; with --update too, where the picture has become the golden. Two different pictures
    // of one name are an error. `tell` says more about the first differing pixel.
    using Tell = std::function<std::string(int x, int y)>;
    Expected<void> check(const std::string& name, const ImageFile& picture, const Tolerance& tolerance = {},
                         const Tell& tell = {});

    // The target's colour, or its depth where it has none (pictureOf). Alpha of floats that is not 1 everywhere is a
    // golden of its own, NAME.alpha.pfm.
    Expected<void> check(const std::string& name, const Framebuffer& target, const Tolerance& tolerance = {},
                         const Tell& tell = {});

    // A test of this name, or all tests in it, failed, and may not have come to its checks: no golden of it is unused.
    void failed(const std::string& test);

    // At the end: of a whole run, in which every test ran, an error that lists the goldens that nobody used. Records of
    // tests that are gone are removed then.
    Expected<void> end(bool isWhole);

    // Goldens that --update has rewritten.
    const std::vector<std::string>& updated() const { return mUpdated; }

private:
    bool mayBeUsed(const std::string& name) const;

    GoldenOptions mOptions;
    std::map<std::string, std::uint64_t> mUsed;  // file names of goldens in the folder, and what their pictures hash to
    std::vector<std::string> mFailed, mUpdated;
};

}  // namespace relief
