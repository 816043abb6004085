// The gallery: every stage as a picture, and one page that shows them in order.
#include <charconv>
#include <cstdio>
#include <filesystem>

#include <unistd.h>

#include "commands.h"
#include "relief/file.h"

namespace relief::samples {

namespace {

constexpr Size kPicture = {960, 540};

std::string page()
{
    std::string html = R"(<!DOCTYPE html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Relief: the gallery</title>
<style>
  body { font: 16px/1.45 system-ui, sans-serif; margin: 2rem auto; max-width: 80rem; padding: 0 1rem;
         background: #16181b; color: #dcdcd6; }
  h2 { margin: 2.5rem 0 1rem; font-weight: 500; }
  main { display: grid; grid-template-columns: repeat(auto-fill, minmax(22rem, 1fr)); gap: 1.5rem; }
  figure { margin: 0; } img { width: 100%; height: auto; display: block; border-radius: 4px; }
  figcaption { padding-top: .4rem; } .new { color: #a5a59c; display: block; font-size: .92em; }
</style>
<h1>Relief</h1>
)";
    std::string tutorial;
    for (const Stage& stage : allStages()) {
        if (stage.tutorial != tutorial) {
            html += (tutorial.empty() ? "" : "</main>\n") + ("<h2>" + stage.tutorial) + "</h2>\n<main>\n";
            tutorial = stage.tutorial;
        }
        const std::string file = stage.folder + "/" + stage.stem + ".png";
        html += "<figure><a href=\"" + file + "\"><img src=\"" + file + "\" width=\"960\" height=\"540\" alt=\"";
        html += stage.title;
        html += "\"></a><figcaption><b>" + stage.name() + "</b> (section ";
        html += stage.section;
        html += ")<span class=\"new\">";
        html += stage.news;
        html += "</span></figcaption></figure>\n";
    }
    return html + "</main>\n</html>\n";
}

// One of `count` parts of the stages: those at index, index + count, ... The same on every machine.
struct Shard
{
    std::size_t index = 0, count = 1;
};

Expected<Shard> parseShard(const std::string& text)
{
    std::uint32_t number = 0, count = 0;
    const char* const end = text.data() + text.size();
    const auto [slash, numberError] = std::from_chars(text.data(), end, number);
    if (numberError == std::errc() && slash != end && *slash == '/') {
        const auto [rest, countError] = std::from_chars(slash + 1, end, count);
        if (countError == std::errc() && rest == end && number >= 1 && number <= count) return Shard{number - 1, count};
    }
    return fail("--shard " + text + ": write I/N with I from 1 to N, such as 2/8");
}

}  // namespace

Expected<void> gallery(const std::string& folder, const std::string& shardText, int threads)
{
    const Expected<Shard> shard = parseShard(shardText);
    if (!shard) return tl::unexpected(shard.error());
    const bool terminal = isatty(STDOUT_FILENO) != 0;
    std::size_t done = 0;
    for (std::size_t i = shard->index; i < allStages().size(); i += shard->count) {
        const Stage& stage = allStages()[i];
        const std::filesystem::path path = std::filesystem::path(folder) / stage.folder / (stage.stem + ".png");
        std::error_code error;
        std::filesystem::create_directories(path.parent_path(), error);
        if (error) {
            return fail(path.parent_path().string() + ": cannot make the folder (" + error.message() +
                        "); choose another with --out");
        }
        ++done;
        if (terminal) {
            std::printf("\r\033[K[%zu/%zu] %s", i + 1, allStages().size(), stage.name().c_str());
            std::fflush(stdout);
        }
        const Expected<PreparedStage> prepared = PreparedStage::prepare(stage);
        if (!prepared) return tl::unexpected(prepared.error());
        const Expected<Statistics> written = renderToFile(*prepared, kPicture, {.threads = threads}, 1, path.string());
        if (!written) return tl::unexpected(written.error());
    }
    const std::filesystem::path index = std::filesystem::path(folder) / "index.html";
    const std::string html = page();
    const Expected<void> written =
        writeFileAtomically(index, {reinterpret_cast<const std::uint8_t*>(html.data()), html.size()});
    if (!written) return tl::unexpected(written.error());
    std::printf("%s%zu pictures. Open %s\n", terminal ? "\r\033[K" : "", done,
                std::filesystem::absolute(index).string().c_str());
    return {};
}

}  // namespace relief::samples
