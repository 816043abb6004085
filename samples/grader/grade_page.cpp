// What a class's grades are written to. Everything that a learner wrote is text here, never markup or a formula.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>

#include <nlohmann/json.hpp>

#include "grader/grade.h"
#include "relief/file.h"
#include "relief/path.h"

namespace relief::samples::grader {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int kEnlarged = 8;  // of the difference

Expected<void> writeText(const std::string& path, const std::string& text)
{
    return writeFileAtomically(path, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

std::string escaped(const std::string& text)
{
    std::string out;
    for (const char c : text) {
        switch (c) {
            case '<':
                out += "&lt;";
                break;
            case '>':
                out += "&gt;";
                break;
            case '&':
                out += "&amp;";
                break;
            case '"':
                out += "&quot;";
                break;
            case '\'':
                out += "&#39;";
                break;
            default:
                out += c;
        }
    }
    return out;
}

// A cell of a table of comma-separated values. What begins as a formula gets a mark that makes it text.
std::string cell(const std::string& given)
{
    std::string text = printable(given);
    if (!text.empty() && std::string("=+-@").find(text[0]) != std::string::npos) text.insert(0, "'");
    for (std::size_t at = 0; (at = text.find('"', at)) != std::string::npos; at += 2) text.insert(at, "\"");
    return "\"" + text + "\"";
}

std::string joined(const std::vector<std::string>& words)
{
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
    return text;
}

Json jsonOf(const std::vector<Graded>& all)
{
    Json list = Json::array();
    for (const Graded& one : all) {
        Json json = {{"learner", one.learner},  {"file", one.file},       {"exercise", one.id},
                     {"solved", one.isSolved},  {"verdict", one.verdict}, {"sentence", one.sentence},
                     {"sameTextAs", one.twins}, {"seconds", one.seconds}};
        if (one.diagnosis) {
            json["knownMistake"] = one.diagnosis->entry;
            json["codesFromGoal"] = {{"mean", one.diagnosis->fromGoal.mean},
                                     {"largest", one.diagnosis->fromGoal.largest}};
        }
        list.push_back(std::move(json));
    }
    return list;
}

std::string csvOf(const std::vector<Graded>& all)
{
    std::string text = "learner,exercise,solved,verdict,sentence,same text as,file,seconds\n";
    for (const Graded& one : all) {
        text += cell(one.learner) + "," + cell(one.id) + "," + (one.isSolved ? "1" : "0") + "," + cell(one.verdict) +
                "," + cell(one.sentence) + "," + cell(joined(one.twins)) + "," + cell(one.file) + "," +
                std::to_string(one.seconds) + "\n";
    }
    return text;
}

Image8 differenceOf(const Image8& first, const Image8& second)
{
    Image8 difference = first;
    for (std::size_t i = 0; i < first.pixels.size() && i < second.pixels.size(); ++i) {
        const int apart = kEnlarged * std::abs(first.pixels[i] - second.pixels[i]);
        difference.pixels[i] = i % 4 == 3 ? std::uint8_t{255} : static_cast<std::uint8_t>(std::min(255, apart));
    }
    return difference;
}

constexpr const char* kHead =
    "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>Grades</title>\n"
    "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src 'self'; style-src "
    "'unsafe-inline'\">\n"
    "<style>body{font:16px/1.4 sans-serif;margin:2em;color:#222;background:#fff}article{margin:0 0 2em;border-top:1px "
    "solid "
    "#ccc;padding-top:1em}figure{display:inline-block;margin:0 .5em .5em 0}img{display:block;max-width:100%}"
    "figcaption{color:#555}pre{white-space:pre-wrap;background:#f4f4f4;padding:.5em}.solved{color:#176b2c}.not{color:#"
    "9c2a10}"
    "table{border-collapse:collapse}td,th{padding:.2em .8em .2em 0;text-align:left}</style></head><body>\n";

std::string figure(const std::string& file, const std::string& caption)
{
    return "<figure><img src=\"pictures/" + file + "\" width=\"" + std::to_string(kWidth) + "\" height=\"" +
           std::to_string(kHeight) + "\" alt=\"" + caption + "\"><figcaption>" + caption + "</figcaption></figure>\n";
}

// Pictures are named after numbers and exercises, never after a learner.
struct Page
{
    std::string folder, text;
    std::map<std::string, Image8> goals;  // by id

    Expected<void> write(const std::string& name, const Image8& picture) const
    {
        return writePng(folder + "/pictures/" + name, picture.width, picture.height, picture.pixels);
    }
    Expected<void> add(const Graded& one, std::size_t number);
};

Expected<void> Page::add(const Graded& one, std::size_t number)
{
    text += "<article id=\"" + std::to_string(number) + "\"><h2>" + escaped(one.learner) + ", " +
            escaped(one.id.empty() ? one.file : one.id + " " + one.title) + ": <span class=\"" +
            (one.isSolved ? "solved" : "not") + "\">" + escaped(one.verdict) + "</span></h2>\n<pre>" +
            escaped(one.sentence) + "</pre>\n";
    if (!one.twins.empty()) text += "<p>The same text in the gap as: " + escaped(joined(one.twins)) + ".</p>\n";
    Expected<void> written;
    if (one.picture) {
        const std::string own = std::to_string(number) + ".png",
                          difference = std::to_string(number) + "-difference.png";
        const Image8& goal = goals.at(one.id);
        written = write(own, *one.picture);
        if (written) written = write(difference, differenceOf(*one.picture, goal));
        text += figure("goal-" + one.id + ".png", "goal") + figure(own, "own") +
                figure(difference, "difference, " + std::to_string(kEnlarged) + " times");
    }
    text += "</article>\n";
    return written;
}

// How many of each exercise are solved, and what is most often wrong.
std::string summary(const std::vector<Graded>& all, const std::vector<Exercise>& exercises)
{
    std::string text = "<table><tr><th>exercise</th><th>solved</th><th>most often wrong</th></tr>\n";
    for (const Exercise& e : exercises) {
        int count = 0, solved = 0;
        std::map<std::string, int> mistakes;
        for (const Graded& one : all) {
            if (one.id != e.id) continue;
            ++count;
            solved += one.isSolved;
            if (!one.isSolved) ++mistakes[one.diagnosis ? one.diagnosis->entry : one.verdict];
        }
        if (count == 0) continue;
        const auto most = std::max_element(mistakes.begin(), mistakes.end(),
                                           [](const auto& a, const auto& b) { return a.second < b.second; });
        text += "<tr><td>" + e.id + " " + escaped(e.title) + "</td><td>" + std::to_string(solved) + " of " +
                std::to_string(count) + "</td><td>" +
                (most == mistakes.end() ? "" : escaped(most->first) + " (" + std::to_string(most->second) + ")") +
                "</td></tr>\n";
    }
    return text + "</table>\n";
}

}  // namespace

Expected<void> writeGrades(const std::string& folder, const std::vector<Graded>& all,
                           const std::vector<Exercise>& exercises)
{
    std::error_code error;
    fs::create_directories(pathOf(folder + "/pictures"), error);
    if (error) return fail(folder + ": cannot be made (" + error.message() + "); name another folder with --output");
    Page page{folder, kHead + ("<h1>Grades</h1>\n" + summary(all, exercises)), {}};
    for (const Exercise& e : exercises) {
        const bool isUsed = std::any_of(all.begin(), all.end(), [&](const Graded& one) { return one.id == e.id; });
        if (!isUsed) continue;
        Expected<Catalogue> catalogue = readCatalogue(e);
        if (!catalogue) return tl::unexpected(catalogue.error());
        if (const auto written = page.write("goal-" + e.id + ".png", catalogue->goal); !written) return written;
        page.goals.emplace(e.id, std::move(catalogue->goal));
    }
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (const auto written = page.add(all[i], i + 1); !written) return written;
    }
    Expected<void> written = writeText(folder + "/index.html", page.text + "</body></html>\n");
    const std::string json = jsonOf(all).dump(2, ' ', false, Json::error_handler_t::replace);
    if (written) written = writeText(folder + "/grades.json", json + "\n");
    if (written) written = writeText(folder + "/grades.csv", csvOf(all));
    return written;
}

}  // namespace relief::samples::grader
