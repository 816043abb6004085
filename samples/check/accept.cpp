// `check accept`: what the review page's list says. Everything is looked at before the first file is touched.
#include <algorithm>
#include <cstdio>

#include <nlohmann/json.hpp>

#include "check/check.h"
#include "relief/check/hash.h"
#include "relief/file.h"
#include "relief/path.h"

namespace relief::samples::check {

namespace {

using Json = nlohmann::json;

std::string textIn(const Json& json, const char* key)
{
    const auto found = json.is_object() ? json.find(key) : json.end();
    return json.is_object() && found != json.end() && found->is_string() ? found->get<std::string>() : "";
}

}  // namespace

Expected<int> accept(const CheckOptions& options)
{
    const Expected<std::vector<std::uint8_t>> file = readFile(options.first);
    if (!file) return tl::unexpected(file.error());
    const Json list = Json::parse(file->begin(), file->end(), nullptr, false);
    if (!list.is_object() || !list.contains("accept") || !list["accept"].is_array())
        return fail(options.first +
                    ": is no list of the review page (it has no \"accept\"); save it there with the key S");
    const std::string failures = options.second.empty() ? textIn(list, "failures") : options.second;
    const Expected<std::vector<GoldenRecord>> records = readRecords(failures);
    if (!records) return tl::unexpected(records.error());

    std::vector<GoldenRecord> accepted;
    for (const Json& entry : list["accept"]) {
        const std::string name = textIn(entry, "name");
        const auto record =
            std::find_if(records->begin(), records->end(), [&](const auto& r) { return r.name == name; });
        if (record == records->end())
            return fail(options.first + ": \"" + name + "\" is not among the records of " + failures +
                        "; review them again");
        if (record->actualHash != textIn(entry, "hash"))
            return fail(options.first + ": \"" + name + "\" is another picture by now; review " + failures + " again");
        GoldenRecord chosen = *record;
        if (!options.goldens.empty()) {
            // Names in a program's goldens are without ending, in a folder's with it.
            const std::string ending = utf8Of(pathOf(record->golden).extension());
            chosen.golden = utf8Of(pathOf(options.goldens) / pathOf(name.ends_with(ending) ? name : name + ending));
        }
        const bool hasPicture = chosen.outcome != GoldenRecord::Outcome::unused;
        const Expected<std::vector<std::uint8_t>> picture = readFile(hasPicture ? chosen.actual : chosen.golden);
        if (!picture) return tl::unexpected(picture.error());
        if (hasPicture && hexadecimal(hashOf(*picture)) != chosen.actualHash)
            return fail(chosen.actual + ": is no longer the picture that was reviewed; run the tests and review again");
        accepted.push_back(chosen);
    }
    for (const GoldenRecord& record : accepted) {
        const Expected<void> done = acceptRecord(record);
        if (!done) return tl::unexpected(done.error());
        const bool isRemoved = record.outcome == GoldenRecord::Outcome::unused;
        std::printf("%s: %s\n", isRemoved ? "removed" : "accepted", record.golden.c_str());
    }
    if (accepted.empty()) std::printf("the list accepts nothing\n");
    return 0;
}

}  // namespace relief::samples::check
