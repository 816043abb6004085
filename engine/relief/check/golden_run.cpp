#include "relief/check/golden_run.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <cstring>
#include <system_error>
#include <utility>

#include "relief/check/hash.h"
#include "relief/path.h"

namespace relief {

namespace {

namespace fs = std::filesystem;

std::uint64_t hashOf(const ImageFile& picture)
{
    return std::visit(
        [](const auto& p) {
            return relief::hashOf({reinterpret_cast<const std::uint8_t*>(p.pixels.data()),
                                   p.pixels.size() * sizeof(p.pixels[0])}) ^
                   static_cast<std::uint64_t>(p.width);
        },
        picture);
}

bool isGolden(const fs::path& path)
{
    return path.extension() == ".png" || path.extension() == ".pfm";
}

}  // namespace

Expected<bool> takeUpdateFlag(int& argc, char** argv)
{
    char** const end = argv + argc;
    char** const kept = std::remove_if(argv + std::min(argc, 1), end,
                                       [](const char* word) { return std::strcmp(word, "--update") == 0; });
    if (kept == end) return false;
    argc = static_cast<int>(kept - argv);
    argv[argc] = nullptr;
    return mayUpdate().map([] { return true; });
}

Expected<void> mayUpdate()
{
    if (std::getenv("CI") == nullptr) return {};
    return fail(
        "--update: refused, because the environment has CI set; run it on your own machine, look at the pictures, and "
        "commit them");
}

std::string goldenNameOf(const std::string& test)
{
    std::string name;
    bool begins = true;  // a folder or the file
    for (const char c : test) {
        const auto code = static_cast<unsigned char>(c);
        const bool stays = code >= 0x80 || std::isalnum(code) != 0 || c == '-' || c == '_' || (c == '.' && !begins) ||
                           (c == '/' && !begins);
        name += stays ? c : '_';
        begins = stays && c == '/';
    }
    return name.empty() || begins ? name + '_' : name;
}

GoldenRun::GoldenRun(GoldenOptions options) : mOptions(std::move(options))
{
    // Records are read from other folders.
    std::error_code error;
    for (std::string* const folder : {&mOptions.goldens, &mOptions.failures}) {
        const fs::path absolute = fs::absolute(pathOf(*folder), error);
        if (!error && !folder->empty()) *folder = utf8Of(absolute);
    }
}

Expected<void> GoldenRun::check(const std::string& name, const ImageFile& picture, const Tolerance& tolerance,
                                const Tell& tell)
{
    if (mOptions.goldens.empty())
        return fail("golden tests: no folder of goldens is given; name one in GoldenOptions::goldens");
    const std::string stem = goldenNameOf(name);
    const std::string file = stem + (std::holds_alternative<ImageFloat>(picture) ? ".pfm" : ".png");
    const std::string golden = utf8Of(pathOf(mOptions.goldens) / pathOf(file));
    const auto [before, isNew] = mUsed.emplace(file, hashOf(picture));
    if (!isNew && before->second != hashOf(picture))
        return fail(golden +
                    ": is the golden of two different pictures of this run; give each check a name of its own");

    removeRecord(mOptions.failures, stem);
    const GoldenCase check{
        .name = stem,
        .golden = golden,
        .actual = "",
        .failures = mOptions.failures,
        .tolerance = tolerance,
        .updating = "run this program again with --update, or `relief check review " + mOptions.failures + "`",
        .tell = tell};
    GoldenRecord record = judge(check, picture, readImage(golden));
    if (!record.passes() && mOptions.update) {
        const Expected<void> accepted = record.actual.empty() ? Expected<void>() : acceptRecord(record);
        record.updated = accepted && !record.actual.empty();
        if (record.updated) mUpdated.push_back(golden);
        record.message += record.updated ? "\nupdated: " + golden
                          : accepted     ? "\nnot updated: there is no picture to take"
                                         : "\nnot updated: " + accepted.error().message;
    }
    const Expected<void> written = writeRecord(mOptions.failures, record);
    if (!record.passes()) return fail(record.message);
    return written;
}

Expected<void> GoldenRun::check(const std::string& name, const Framebuffer& target, const Tolerance& tolerance,
                                const Tell& tell)
{
    const Expected<ImageFile> picture = pictureOf(target);
    if (!picture) return fail(name + ": " + picture.error().message);
    const Expected<void> checked = check(name, *picture, tolerance, tell);
    const Expected<ImageFile> alpha = alphaOf(target);
    if (!alpha) return checked;
    const auto& values = std::get<ImageFloat>(*alpha).pixels;
    std::error_code ignored;
    const std::string alphaName = name + ".alpha";
    const bool isOpaque = std::all_of(values.begin(), values.end(), [](float value) { return value == 1.0f; });
    if (isOpaque && !fs::exists(pathOf(mOptions.goldens) / pathOf(goldenNameOf(alphaName) + ".pfm"), ignored))
        return checked;
    const Expected<void> checkedAlpha = check(alphaName, *alpha, tolerance, tell);
    if (checked || checkedAlpha) return checked ? checkedAlpha : checked;
    return fail(checked.error().message + "\n" + checkedAlpha.error().message);
}

void GoldenRun::failed(const std::string& test)
{
    mFailed.push_back(goldenNameOf(test));
}

bool GoldenRun::mayBeUsed(const std::string& name) const
{
    return std::any_of(mFailed.begin(), mFailed.end(), [&](const std::string& test) {
        return name.starts_with(test) &&
               (name.size() == test.size() || name[test.size()] == '/' || name[test.size()] == '.');
    });
}

Expected<void> GoldenRun::end(bool isWhole)
{
    if (!isWhole || mOptions.goldens.empty()) return {};
    std::error_code error;
    std::vector<GoldenRecord> unused;
    for (auto it = fs::recursive_directory_iterator(pathOf(mOptions.goldens), error);
         !error && it != fs::recursive_directory_iterator(); it.increment(error)) {
        const std::string file = utf8Of(it->path().lexically_relative(pathOf(mOptions.goldens)));
        const std::string name = file.substr(0, file.rfind('.'));
        if (!isGolden(it->path()) || mUsed.count(file) != 0 || mayBeUsed(name)) continue;
        GoldenRecord record;
        record.name = name;
        record.outcome = GoldenRecord::Outcome::unused;
        record.golden = utf8Of(it->path());
        record.message = record.golden + ": no test uses this golden; remove the file, or name the test as it was";
        unused.push_back(record);
    }
    std::sort(unused.begin(), unused.end(), [](const auto& a, const auto& b) { return a.name < b.name; });

    if (const Expected<std::vector<GoldenRecord>> records = readRecords(mOptions.failures)) {
        for (const GoldenRecord& record : *records) {
            const bool isUsed = mUsed.count(record.name + ".png") + mUsed.count(record.name + ".pfm") != 0;
            if (!isUsed && !mayBeUsed(record.name)) removeRecord(mOptions.failures, record.name);
        }
    }
    std::string message;
    for (const GoldenRecord& record : unused) {
        const Expected<void> written = writeRecord(mOptions.failures, record);
        message += (message.empty() ? "" : "\n") + record.message + (written ? "" : "\n" + written.error().message);
    }
    if (unused.empty()) return {};
    return fail(message);
}

}  // namespace relief
