// `check folder`: every picture of one folder against the golden of the same name in another, on all cores.
#include <algorithm>
#include <cstdio>
#include <map>
#include <set>
#include <sstream>
#include <system_error>

#include "check/check.h"
#include "relief/check/golden.h"
#include "relief/check/golden_run.h"
#include "relief/file.h"
#include "relief/path.h"
#include "relief/pipeline/workers.h"

namespace relief::samples::check {

namespace {

namespace fs = std::filesystem;
using Outcome = GoldenRecord::Outcome;

bool isPicture(const fs::path& path)
{
    static const std::set<std::string> kEndings = {".png", ".jpg", ".jpeg", ".tga", ".bmp", ".hdr", ".pfm"};
    return kEndings.count(utf8Of(path.extension())) != 0;
}

// The names of all pictures in a folder and those in it, relative to it.
Expected<void> addNames(const std::string& folder, std::set<std::string>& names)
{
    std::error_code error;
    for (auto it = fs::recursive_directory_iterator(pathOf(folder), error);
         !error && it != fs::recursive_directory_iterator(); it.increment(error)) {
        if (isPicture(it->path())) names.insert(utf8Of(it->path().lexically_relative(pathOf(folder))));
    }
    if (!error) return {};
    return fail(folder + ": cannot read the folder (" + error.message() + "); name one with pictures");
}

// Lines of a name and what must differ there.
Expected<std::map<std::string, Tolerance>> readRanges(const std::string& path)
{
    std::map<std::string, Tolerance> ranges;
    if (path.empty()) return ranges;
    const Expected<std::vector<std::uint8_t>> file = readFile(path);
    if (!file) return tl::unexpected(file.error());
    std::istringstream lines(std::string(file->begin(), file->end()));
    int number = 0;
    for (std::string line; std::getline(lines, line);) {
        ++number;
        if (!line.empty() && line.back() == '\r') line.pop_back();
        if (line.empty() || line[0] == '#') continue;
        const std::size_t space = line.find(' ');
        const std::string range = space == std::string::npos ? "" : line.substr(space + 1);
        const Expected<Tolerance> tolerance = toleranceOf(range);
        const std::string where = path + ": line " + std::to_string(number) + ": ";
        if (!tolerance) return fail(where + tolerance.error().message);
        if (tolerance->isExact()) return fail(where + "has no range; write it as in a/b.png pixels=40-60 largest=1-2");
        ranges[line.substr(0, space)] = *tolerance;
    }
    return ranges;
}

// Decodes a file once where picture and golden are the same bytes.
GoldenRecord compareOne(const GoldenCase& check)
{
    std::error_code ignored;
    if (!fs::exists(pathOf(check.actual), ignored)) {
        GoldenRecord record;
        record.name = check.name;
        record.golden = check.golden;
        record.outcome = Outcome::unused;
        record.message = check.golden + ": there is no picture of this golden; remove the file, or draw it again";
        return record;
    }
    Expected<std::vector<std::uint8_t>> actual = readFile(check.actual), golden = readFile(check.golden);
    const bool isSame = actual && golden && *actual == *golden;
    const auto decode = [](Expected<std::vector<std::uint8_t>>& bytes, const std::string& name) {
        return bytes ? decodeImage(std::move(*bytes), name) : Expected<ImageFile>(tl::unexpected(bytes.error()));
    };
    const Expected<ImageFile> picture = decode(actual, check.actual);
    if (isSame) return judge(check, picture, picture);
    return judge(check, picture, decode(golden, check.golden));
}

// With --update: the record's picture becomes the golden.
void update(GoldenRecord& record)
{
    if (record.passes() || record.outcome == Outcome::unused || record.actualHash.empty()) return;
    const Expected<void> accepted = acceptRecord(record);
    record.updated = accepted.has_value();
    record.message += accepted ? "\nupdated: " + record.golden : "\nnot updated: " + accepted.error().message;
}

}  // namespace

Expected<int> compareFolders(const CheckOptions& options)
{
    if (options.update) {
        if (const Expected<void> allowed = mayUpdate(); !allowed) return tl::unexpected(allowed.error());
    }
    std::set<std::string> found;
    for (const std::string& folder : {options.first, options.second}) {
        if (const Expected<void> added = addNames(folder, found); !added) return tl::unexpected(added.error());
    }
    const std::vector<std::string> names(found.begin(), found.end());
    if (names.empty()) return fail(options.first + ": has no pictures, and neither has " + options.second);
    const Expected<std::map<std::string, Tolerance>> ranges = readRanges(options.ranges);
    if (!ranges) return tl::unexpected(ranges.error());
    for (const auto& [name, range] : *ranges) {
        if (found.count(name) == 0)
            return fail(options.ranges + ": " + name + ": there is no such picture; remove the line");
    }

    // Records are read from other folders.
    std::error_code error;
    const auto absolute = [&](const std::string& path) { return utf8Of(fs::absolute(pathOf(path), error)); };
    const std::string failures = absolute(options.failures), actual = absolute(options.first),
                      golden = absolute(options.second);
    if (const Expected<std::vector<GoldenRecord>> before = readRecords(failures)) {
        for (const GoldenRecord& record : *before) removeRecord(failures, record.name);
    }
    std::vector<GoldenRecord> records(names.size());
    std::vector<Expected<void>> written(names.size());
    Workers(options.threads).run(static_cast<int>(names.size()), [&](int task, int) {
        const auto i = static_cast<std::size_t>(task);
        const auto range = ranges->find(names[i]);
        records[i] = compareOne({.name = names[i],
                                 .golden = utf8Of(pathOf(golden) / pathOf(names[i])),
                                 .actual = utf8Of(pathOf(actual) / pathOf(names[i])),
                                 .failures = failures,
                                 .tolerance = range == ranges->end() ? Tolerance() : range->second,
                                 .updating = "run this again with --update, or `relief check review`"});
        if (options.update) update(records[i]);
        written[i] = writeRecord(failures, records[i]);
    });
    for (const Expected<void>& record : written) {
        if (!record) return tl::unexpected(record.error());
    }
    std::size_t failed = 0;
    for (const GoldenRecord& record : records) {
        if (record.passes()) continue;
        ++failed;
        std::printf("%s\n\n", record.message.c_str());
    }
    if (!options.junit.empty()) {
        const Expected<void> junit = writeText(options.junit, junitOf(records));
        if (!junit) return tl::unexpected(junit.error());
    }
    std::printf("%zu of %zu pictures are as they should be", names.size() - failed, names.size());
    if (failed > 0) std::printf("; look at the others: relief check review '%s'", options.failures.c_str());
    std::printf("\n");
    return failed > 0 ? 1 : 0;
}

}  // namespace relief::samples::check
