#include <algorithm>
#include <cstdio>

#include "relief/texture/color_space.h"
#include "relief/texture/image.h"
#include "trace/tell.h"
#include "trace/words.h"

namespace relief::samples::trace {

namespace {

std::string escaped(const std::string& text)
{
    std::string all;
    for (const char c : text) {
        all += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '"' ? "&quot;" : std::string(1, c);
    }
    return all;
}

std::string base64(std::span<const std::uint8_t> bytes)
{
    static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t word = 0;
        for (std::size_t k = 0; k < 3; ++k) word = word << 8 | (k < count ? bytes[i + k] : 0u);
        for (std::size_t k = 0; k < 4; ++k) text += k <= count ? kDigits[word >> (18 - 6 * k) & 63u] : '=';
    }
    return text;
}

std::string hexadecimal(std::uint32_t r, std::uint32_t g, std::uint32_t b)
{
    char text[8];
    std::snprintf(text, sizeof text, "#%02x%02x%02x", r & 255u, g & 255u, b & 255u);
    return text;
}

// A linear colour as a screen shows it.
std::string cssOf(const std::array<float, 3>& linear)
{
    std::uint32_t code[3];
    for (std::size_t c = 0; c < 3; ++c)
        code[c] = static_cast<std::uint32_t>(linearToSrgb(Float(std::clamp(linear[c], 0.0f, 1.0f)))[0] * 255.0f + 0.5f);
    return hexadecimal(code[0], code[1], code[2]);
}

// A direction as a normal map shows it.
std::string cssOfDirection(const std::array<float, 3>& d)
{
    std::uint32_t code[3];
    for (std::size_t c = 0; c < 3; ++c)
        code[c] = static_cast<std::uint32_t>(std::clamp(d[c] * 0.5f + 0.5f, 0.0f, 1.0f) * 255.0f + 0.5f);
    return hexadecimal(code[0], code[1], code[2]);
}

std::string rowOf(const Node& node)
{
    std::string row;
    if (node.color) row += "<i style=\"background:" + cssOf(*node.color) + "\"></i>";
    if (node.direction) row += "<i class=\"d\" style=\"background:" + cssOfDirection(*node.direction) + "\"></i>";
    row += "<b>" + escaped(titleOf(node)) + "</b> " + escaped(node.place.empty() ? node.value : node.place);
    if (node.isInvalid) row += " <em>not finite</em>";
    return row;
}

std::string tableOf(const Quad& quad)
{
    std::string html = "<table>";
    for (std::size_t i = 0; i < 4; ++i) {
        html += i % 2 == 0 ? "<tr>" : "";
        html += static_cast<int>(i) == quad.pixel ? "<th>" : "<td>";
        html += escaped(quad.values[i]);
    }
    html += "</table>";
    if (!quad.ddx.empty()) html += "<p>ddx " + escaped(quad.ddx) + "</p><p>ddy " + escaped(quad.ddy) + "</p>";
    return html + "\n";
}

// `lastCode`: the source's line that stands above already.
void write(const Node& node, std::string_view lastCode, std::string& html)
{
    if (!node.code.empty() && node.code != lastCode) html += "<code>" + escaped(node.code) + "</code>";
    if (node.children.empty() && !node.quad) {
        html += "<p>" + rowOf(node) + "</p>\n";
        return;
    }
    const bool isValue = !node.code.empty() || node.quad;
    html += std::string("<details") + (node.isFolded || isValue ? "" : " open") + "><summary>" + rowOf(node) +
            "</summary>\n";
    if (node.quad) html += tableOf(*node.quad);
    std::string_view code;
    for (const Node& child : node.children) {
        write(child, code, html);
        if (!child.code.empty()) code = child.code;
    }
    html += "</details>\n";
}

std::string neighbours(const PixelTrace& trace, std::span<const std::uint32_t> picture)
{
    constexpr int kReach = 5;
    std::string html = "<div class=\"near\" role=\"img\" aria-label=\"The pixel and its neighbours, enlarged\">";
    for (int dy = -kReach; dy <= kReach; ++dy) {
        for (int dx = -kReach; dx <= kReach; ++dx) {
            const int x = trace.x + dx, y = trace.y + dy;
            const bool isThere = x >= 0 && y >= 0 && x < trace.width && y < trace.height;
            const std::uint32_t p = isThere
                                        ? picture[static_cast<std::size_t>(y) * static_cast<std::size_t>(trace.width) +
                                                  static_cast<std::size_t>(x)]
                                        : 0u;
            const std::string color = hexadecimal(p, p >> 8, p >> 16);
            html += "<span" + std::string(dx == 0 && dy == 0 ? " class=\"here\"" : "") +
                    " style=\"background:" + (isThere ? color : "transparent") + "\" title=\"" +
                    (isThere ? std::to_string(x) + "," + std::to_string(y) + " " + color : "") + "\"></span>";
        }
    }
    return html + "</div>";
}

constexpr const char* kStyle = R"(
:root { color-scheme: light dark; --line: #8886; --quiet: #8882; }
body { font: 15px/1.5 system-ui, sans-serif; margin: 0; display: grid; grid-template-columns: minmax(18rem, 30rem) 1fr; gap: 2rem; padding: 1.5rem; }
aside { position: sticky; top: 1.5rem; align-self: start; }
h1 { font-size: 1.3rem; margin: 0 0 .5rem; }
.picture { position: relative; line-height: 0; }
.picture img { width: 100%; image-rendering: auto; border-radius: 4px; }
.picture u { position: absolute; width: 15px; height: 15px; margin: -8px; border: 2px solid #fff; outline: 1px solid #000; border-radius: 50%; }
.near { display: grid; grid-template-columns: repeat(11, 1fr); aspect-ratio: 1; width: 60%; margin: 1rem 0; }
.near .here { outline: 2px solid #fff; box-shadow: 0 0 0 3px #000; z-index: 1; }
summary { cursor: pointer; }
details > *:not(summary) { margin-left: .45rem; border-left: 2px solid var(--line); padding-left: .9rem; }
details > details { padding-left: .6rem; }
p { margin: .1rem 0; }
main p { padding-left: 1.1rem; }
b { font-weight: 600; }
i { display: inline-block; width: .9em; height: .9em; border: 1px solid var(--line); margin-right: .35em; vertical-align: -.1em; }
i.d { border-radius: 50%; }
main code { display: block; font: 13px/1.6 ui-monospace, monospace; background: var(--quiet); white-space: pre-wrap; }
table { border-collapse: collapse; font-size: 13px; margin: .2rem 0; }
td, th { border: 1px solid var(--line); padding: .1rem .5rem; font-weight: 400; }
th { background: var(--quiet); font-weight: 600; }
em { color: #d33; font-style: normal; font-weight: 600; }
kbd { font: 12px ui-monospace, monospace; word-break: break-all; }
@media (max-width: 60rem) { body { grid-template-columns: 1fr; } aside { position: static; } }
)";

}  // namespace

Expected<std::string> toHtml(const PixelTrace& trace, const Subject& subject, std::span<const std::uint32_t> picture)
{
    std::vector<std::uint8_t> rgba;
    for (const std::uint32_t pixel : picture) {
        for (int shift = 0; shift < 32; shift += 8) rgba.push_back(static_cast<std::uint8_t>(pixel >> shift));
    }
    const Expected<std::vector<std::uint8_t>> png = encodePng(subject.stage, trace.width, trace.height, rgba);
    if (!png) return tl::unexpected(png.error());
    const auto percent = [](int at, int size) {
        return number((static_cast<float>(at) + 0.5f) * 100.0f / static_cast<float>(size)) + "%";
    };
    const std::string where = std::to_string(trace.x) + "," + std::to_string(trace.y);
    std::string html =
        "<!DOCTYPE html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
        "content=\"width=device-width\">\n<title>" +
        escaped(subject.stage) + ", pixel " + where + "</title>\n<style>" + kStyle + "</style>\n<aside>\n<h1>" +
        escaped(subject.stage) + "<br>The life of pixel " + where +
        "</h1>\n<div class=\"picture\"><img alt=\"The picture\" src=\"data:image/png;base64," + base64(*png) +
        "\"><u style=\"left:" + percent(trace.x, trace.width) + ";top:" + percent(trace.y, trace.height) +
        "\"></u></div>\n" + neighbours(trace, picture) +
        "\n<p><i style=\"background:" + hexadecimal(trace.stored[0], trace.stored[1], trace.stored[2]) +
        "\"></i>stored: " + escaped(storedText(trace.format, trace.storedWords)) + "</p>\n<p>Made by <kbd>" +
        escaped(subject.command) + "</kbd></p>\n</aside>\n<main>\n";
    write(tell(trace, subject), "", html);
    return html + "</main>\n</html>\n";
}

}  // namespace relief::samples::trace
