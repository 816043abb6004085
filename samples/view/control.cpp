#include "view/control.h"

#include <set>

namespace relief::samples {

namespace {

// "0: per vertex, 1: per fragment, 2: both" names the choices 0 ... maximum. None where it does not name them all.
std::vector<std::string> choicesIn(const std::string& meaning, float maximum)
{
    std::vector<std::string> names;
    for (int i = 0; i <= static_cast<int>(maximum); ++i) {
        const std::string number = std::to_string(i) + ": ";
        const std::size_t begin = meaning.find((i > 0 ? ", " : "") + number);
        if (begin == std::string::npos || (i == 0 && begin != 0)) return {};
        const std::size_t from = begin + number.size() + (i > 0 ? 2 : 0);
        const std::size_t end = meaning.find(", " + std::to_string(i + 1) + ": ", from);
        names.push_back(meaning.substr(from, end == std::string::npos ? end : end - from));
    }
    return names;
}

}  // namespace

Control controlOf(const Property& p)
{
    using Kind = Control::Kind;
    static const std::set<std::string> ticks = {"tutorialForm", "glossFromRed", "exact", "asColors"};
    static const std::set<std::string> whole = {"weights", "squares", "maxAnisotropy"};
    const bool unit = p.minimum == 0.0f && p.maximum == 1.0f;
    if (p.components >= 3 && unit) return {Kind::color, {}};
    if (p.components > 1) return {Kind::vector, {}};
    if (unit && ticks.contains(p.name)) return {Kind::tick, {}};
    if (whole.contains(p.name)) return {Kind::whole, {}};
    if (p.minimum == 0.0f && p.maximum >= 1.0f && p.maximum <= 9.0f) {
        std::vector<std::string> names = choicesIn(p.meaning, p.maximum);
        if (!names.empty()) return {Kind::choice, std::move(names)};
    }
    return {Kind::number, {}};
}

}  // namespace relief::samples
