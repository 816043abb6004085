#include "relief/check/record.h"

#include <algorithm>
#include <iterator>
#include <system_error>

#include <nlohmann/json.hpp>

#include "relief/check/hash.h"
#include "relief/file.h"
#include "relief/path.h"

namespace relief {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kOutcomes[] = {"same", "in range", "different", "other kind", "missing", "unreadable", "unused"};

std::span<const std::uint8_t> bytesOfText(const std::string& text)
{
    return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

// A path as it is written into the record: relative where it lies in the folder.
std::string storedPath(const std::string& folder, const std::string& path)
{
    const fs::path relative = pathOf(path).lexically_relative(pathOf(folder));
    return relative.empty() || *relative.begin() == ".." ? path : utf8Of(relative);
}

std::string textIn(const Json& json, const char* key)
{
    const auto found = json.find(key);
    return found != json.end() && found->is_string() ? found->get<std::string>() : "";
}

std::uint64_t numberIn(const Json& json, const char* key)
{
    const auto found = json.find(key);
    return found != json.end() && found->is_number_unsigned() ? found->get<std::uint64_t>() : 0;
}

Expected<GoldenRecord> readRecord(const std::string& folder, const std::string& path)
{
    const Expected<std::vector<std::uint8_t>> file = readFile(path);
    if (!file) return tl::unexpected(file.error());
    const Json json = Json::parse(file->begin(), file->end(), nullptr, false);
    const std::string outcome = json.is_object() ? textIn(json, "outcome") : "";
    const auto* const word = std::find(std::begin(kOutcomes), std::end(kOutcomes), outcome);
    if (word == std::end(kOutcomes)) {
        return fail(path + ": is no record of a golden test (its outcome is \"" + outcome +
                    "\"); run the tests again, or name another folder");
    }
    const auto pathIn = [&](const char* key) {
        const std::string text = textIn(json, key);
        return text.empty() ? text : utf8Of(pathOf(folder) / pathOf(text));
    };
    GoldenRecord record;
    record.name = textIn(json, "name");
    record.outcome = static_cast<GoldenRecord::Outcome>(word - std::begin(kOutcomes));
    record.golden = pathIn("golden");
    record.actual = pathIn("actual");
    record.difference = pathIn("difference");
    record.actualHash = textIn(json, "actualHash");
    record.differing = numberIn(json, "differing");
    record.largest = numberIn(json, "largest");
    record.window8x8 = numberIn(json, "window8x8");
    record.range = textIn(json, "range");
    record.message = textIn(json, "message");
    record.updated = json.value("updated", Json(false)) == Json(true);
    return record;
}

// XML 1.0 has no way to write most control characters.
std::string escaped(const std::string& text)
{
    std::string all;
    for (const char c : text) {
        if (static_cast<unsigned char>(c) < 0x20 && c != '\n') {
            all += '?';
        } else {
            all += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '"' ? "&quot;" : std::string(1, c);
        }
    }
    return all;
}

}  // namespace

const char* wordOf(GoldenRecord::Outcome outcome)
{
    return kOutcomes[static_cast<std::size_t>(outcome)];
}

Expected<void> writeRecord(const std::string& folder, const GoldenRecord& record)
{
    Json json;
    json["name"] = record.name;
    json["outcome"] = wordOf(record.outcome);
    if (!record.golden.empty()) json["golden"] = storedPath(folder, record.golden);
    if (!record.actual.empty()) json["actual"] = storedPath(folder, record.actual);
    if (!record.difference.empty()) json["difference"] = storedPath(folder, record.difference);
    if (!record.actualHash.empty()) json["actualHash"] = record.actualHash;
    json["differing"] = record.differing;
    json["largest"] = record.largest;
    json["window8x8"] = record.window8x8;
    if (!record.range.empty()) json["range"] = record.range;
    if (!record.message.empty()) json["message"] = record.message;
    if (record.updated) json["updated"] = true;
    const fs::path path = pathOf(folder) / pathOf(record.name + ".json");
    std::error_code error;
    fs::create_directories(path.parent_path(), error);
    if (error)
        return fail(utf8Of(path.parent_path()) + ": cannot make the folder (" + error.message() +
                    "); choose another one");
    return writeFileAtomically(utf8Of(path),
                               bytesOfText(json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n"));
}

Expected<std::vector<GoldenRecord>> readRecords(const std::string& folder)
{
    std::vector<GoldenRecord> records;
    std::error_code error;
    for (auto it = fs::recursive_directory_iterator(pathOf(folder), error);
         !error && it != fs::recursive_directory_iterator(); it.increment(error)) {
        if (it->path().extension() != ".json") continue;
        const Expected<GoldenRecord> record = readRecord(folder, utf8Of(it->path()));
        if (!record) return tl::unexpected(record.error());
        records.push_back(*record);
    }
    if (error)
        return fail(folder + ": cannot read the folder (" + error.message() + "); name the one that the tests wrote");
    std::sort(records.begin(), records.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
    return records;
}

void removeRecord(const std::string& folder, const std::string& name)
{
    std::error_code ignored;
    for (const char* ending : {".json", ".actual.png", ".actual.pfm", ".difference.png"})
        fs::remove(pathOf(folder) / pathOf(name + ending), ignored);
}

std::string junitOf(const std::vector<GoldenRecord>& records)
{
    const auto failed = std::count_if(records.begin(), records.end(), [](const auto& r) { return !r.passes(); });
    std::string xml =
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n<testsuite name=\"relief check\" tests=\"" +
        std::to_string(records.size()) + "\" failures=\"" + std::to_string(failed) + "\">\n";
    for (const GoldenRecord& record : records) {
        const std::size_t slash = record.name.rfind('/');
        const bool hasFolder = slash != std::string::npos;
        xml += "<testcase classname=\"" + escaped(hasFolder ? record.name.substr(0, slash) : "golden") + "\" name=\"" +
               escaped(record.name.substr(hasFolder ? slash + 1 : 0)) + "\"";
        if (record.passes()) {
            xml += "/>\n";
            continue;
        }
        xml += ">\n<failure type=\"" + std::string(wordOf(record.outcome)) + "\" message=\"" +
               escaped(record.message.substr(0, record.message.find('\n'))) + "\">" + escaped(record.message) +
               "</failure>\n</testcase>\n";
    }
    return xml + "</testsuite>\n</testsuites>\n";
}

Expected<void> acceptRecord(const GoldenRecord& record)
{
    std::error_code error;
    if (record.outcome == GoldenRecord::Outcome::unused) {
        fs::remove(pathOf(record.golden), error);
        if (!error) return {};
        return fail(record.golden + ": cannot be removed (" + error.message() + "); check its permissions");
    }
    const Expected<std::vector<std::uint8_t>> picture = readFile(record.actual);
    if (!picture) return tl::unexpected(picture.error());
    if (hexadecimal(hashOf(*picture)) != record.actualHash)
        return fail(record.actual +
                    ": is no longer the picture that the record tells of; run the tests and review again");
    const fs::path folder = pathOf(record.golden).parent_path();
    if (!folder.empty()) fs::create_directories(folder, error);
    if (error) return fail(utf8Of(folder) + ": cannot make the folder (" + error.message() + "); choose another one");
    return writeFileAtomically(record.golden, *picture);
}

}  // namespace relief
