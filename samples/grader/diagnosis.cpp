#include "grader/diagnosis.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "relief/check/hash.h"

namespace relief::samples::grader {

namespace {

using Kind = Diagnosis::Kind;

std::string text(const char* format, double number)
{
    char buffer[64];
    std::snprintf(buffer, sizeof buffer, format, number);
    return buffer;
}

const Mistake* mistakeOf(const Exercise& exercise, const std::string& name)
{
    for (const Mistake& m : exercise.mistakes) {
        if (m.name == name) return &m;
    }
    return nullptr;
}

// What an entry says: "Your v slope has the wrong sign", or two of them, and where to read.
struct Words
{
    std::string sentence, see;
};

Words wordsOf(const Exercise& exercise, const std::string& entry)
{
    const std::size_t plus = entry.find('+');
    if (const Mistake* const one = mistakeOf(exercise, entry)) return {one->sentence, one->see};
    if (entry == "answer") return {"the goal itself", ""};
    if (plus == std::string::npos) return {"the file as it was given", ""};
    const Words first = wordsOf(exercise, entry.substr(0, plus)), second = wordsOf(exercise, entry.substr(plus + 1));
    const std::string see = first.see.empty() || first.see == second.see
                                ? second.see
                                : first.see + (second.see.empty() ? "" : " ") + second.see;
    return {"Two things: " + first.sentence + (first.sentence.ends_with("?") ? " " : ". ") + second.sentence, see};
}

// "Your slope has the wrong sign: your picture ...", but no second colon, and no full stop after a question.
std::string joined(const std::string& sentence, const std::string& picture)
{
    if (sentence.ends_with("?")) return sentence + " Your picture " + picture;
    return sentence.find(": ") == std::string::npos ? sentence + ": your picture " + picture
                                                    : sentence + ". Your picture " + picture;
}

std::string withSee(const std::string& sentence, const std::string& see)
{
    return see.empty() ? sentence : sentence + " " + see;
}

// Of the entries, the nearest and the one after it.
struct Nearest
{
    const Entry* entry = nullptr;
    double nearest = 1e9, next = 1e9;
};

Nearest nearestTo(const Catalogue& catalogue, const Image8& small)
{
    Nearest found;
    for (const Entry& entry : catalogue.entries) {
        const double distance = distanceOf(entry.small.pixels, small.pixels, kSmallWidth).mean;
        if (distance < found.nearest) {
            found.next = found.nearest;
            found.nearest = distance;
            found.entry = &entry;
        } else {
            found.next = std::min(found.next, distance);
        }
    }
    return found;
}

std::string fromGoal(const Distance& distance)
{
    return "Your picture is " + text("%.1f", distance.mean) + " codes of 255 away from the goal on average, and " +
           std::to_string(distance.largest) + " at most, at pixel (" + std::to_string(distance.x) + ", " +
           std::to_string(distance.y) + ")";
}

std::string solvedToCodes(const Distance& distance)
{
    if (distance.largest == 0) {
        return "Solved: every code of every pixel is the goal's. The numbers behind them are rounded differently, as "
               "in a "
               "sum in another order.";
    }
    return "Solved, to " + std::to_string(distance.largest) + (distance.largest == 1 ? " code" : " codes") +
           " of 255: " + std::to_string(distance.differing) + " pixels differ from the goal, by the most at (" +
           std::to_string(distance.x) + ", " + std::to_string(distance.y) +
           "). The same numbers in another order are rounded differently.";
}

// Where the picture is no entry's, bit for bit.
void compareWithAll(const Exercise& exercise, const Catalogue& catalogue, const Image8& codes, Diagnosis& diagnosis)
{
    const Nearest found = nearestTo(catalogue, smallOf(codes));
    diagnosis.entry = found.entry->name;
    diagnosis.nearest = found.nearest;
    diagnosis.next = found.next;
    const Words words = wordsOf(exercise, found.entry->name);
    const std::string howNear =
        text("%.2f", found.nearest) + " codes of 255 away on average, the next one " + text("%.2f", found.next);
    const bool isMistake = found.entry->name != "answer" && found.entry->name != "start";
    if (isMistake && found.nearest <= kNear && found.nearest * kMargin <= found.next && found.next >= kTie) {
        diagnosis.kind = Kind::near;
        diagnosis.sentence =
            withSee(joined(words.sentence, "is nearest to what that gives, of all known mistakes (" + howNear + ")."),
                    words.see);
        return;
    }
    diagnosis.kind = Kind::unknown;
    diagnosis.sentence = "Not solved, and none of the " + std::to_string(catalogue.entries.size() - 2) +
                         " known mistakes gives this picture. " + fromGoal(diagnosis.fromGoal) + ". ";
    diagnosis.sentence += found.entry->name == "answer"
                              ? "That is nearer than any known mistake: look at the difference in `./relief view`."
                              : "The nearest known picture says little: \"" + words.sentence + "\" (" + howNear + ").";
}

double measureOf(const std::string& name, const Image8& picture)
{
    const double count = static_cast<double>(picture.pixels.size()) / 4.0;
    double sum = 0.0, squares = 0.0, brightest = 0.0, bright = 0.0, saturation = 0.0, channels[3] = {};
    for (std::size_t i = 0; i < picture.pixels.size(); i += 4) {
        const double r = picture.pixels[i] / 255.0, g = picture.pixels[i + 1] / 255.0,
                     b = picture.pixels[i + 2] / 255.0;
        const double grey = (r + g + b) / 3.0;
        sum += grey;
        squares += grey * grey;
        brightest = std::max(brightest, grey);
        bright += grey >= 0.8 ? 1.0 : 0.0;
        saturation += std::max({r, g, b}) - std::min({r, g, b});
        channels[0] += r;
        channels[1] += g;
        channels[2] += b;
    }
    if (name == "mean") return sum / count;
    if (name == "brightest") return brightest;
    if (name == "bright") return bright / count;
    if (name == "contrast") return std::sqrt(std::max(0.0, squares / count - sum * sum / count / count));
    if (name == "saturation") return saturation / count;
    return channels[name == "red" ? 0 : name == "green" ? 1 : 2] / count;
}

Diagnosis judgeOpen(const Exercise& exercise, const Catalogue& catalogue, const Image8& codes, Diagnosis diagnosis)
{
    const std::vector<std::string> missing = unmet(exercise, smallOf(codes), catalogue.entries[1].small);
    if (missing.empty()) {
        diagnosis.kind = Kind::open;
        diagnosis.sentence = "All " + std::to_string(exercise.conditions.size()) +
                             " conditions hold. Nothing else is marked: whether it looks right, you have to judge.";
        return diagnosis;
    }
    if (diagnosis.kind == Kind::exact) return diagnosis;
    diagnosis.kind = Kind::conditions;
    diagnosis.sentence = "Not yet:";
    for (const std::string& condition : missing) diagnosis.sentence += " " + condition + ".";
    return diagnosis;
}

}  // namespace

const char* wordOf(Kind kind)
{
    switch (kind) {
        case Kind::solved:
            return "solved";
        case Kind::nearly:
            return "nearly";
        case Kind::open:
            return "open";
        case Kind::exact:
            return "mistake";
        case Kind::near:
            return "near a mistake";
        case Kind::start:
            return "as given";
        case Kind::conditions:
            return "conditions";
        case Kind::unknown:
            return "unknown";
    }
    return "";
}

std::vector<std::string> unmet(const Exercise& exercise, const Image8& picture, const Image8& start)
{
    std::vector<std::string> missing;
    for (const Condition& c : exercise.conditions) {
        const double is = measureOf(c.measure, picture);
        const double bound = c.number * (c.ofStart ? measureOf(c.measure, start) : 1.0);
        if (c.relation == "<=" ? is <= bound : is >= bound) continue;
        missing.push_back(c.meaning + ": " + c.measure + " is " + text("%.3f", is) + ", and should be " +
                          (c.relation == "<=" ? "at most " : "at least ") + text("%.3f", bound));
    }
    return missing;
}

Diagnosis diagnose(const Exercise& exercise, const Catalogue& catalogue, const Framebuffer& picture)
{
    return diagnose(exercise, catalogue, hexadecimal(hashOf(picture)), codesOf(picture));
}

Diagnosis diagnose(const Exercise& exercise, const Catalogue& catalogue, const std::string& hash, const Image8& codes)
{
    Diagnosis diagnosis;
    diagnosis.fromGoal = distanceOf(codes.pixels, catalogue.goal.pixels, kWidth);
    for (const Entry& entry : catalogue.entries) {
        if (entry.hash != hash) continue;
        diagnosis.entry = entry.name;
        const bool isMistake = entry.name.find('+') != std::string::npos || mistakeOf(exercise, entry.name) != nullptr;
        diagnosis.kind = isMistake ? Kind::exact : entry.name == "start" ? Kind::start : Kind::solved;
        const Words words = wordsOf(exercise, entry.name);
        diagnosis.sentence = isMistake ? withSee(joined(words.sentence, "is, bit for bit, what that gives."), words.see)
                             : entry.name == "start"
                                 ? "Your picture is the one of the file as it was given: fill the gap and try again."
                                 : "Solved, bit for bit.";
    }
    if (exercise.isOpen()) return judgeOpen(exercise, catalogue, codes, std::move(diagnosis));
    if (!diagnosis.entry.empty()) return diagnosis;
    if (diagnosis.fromGoal.largest <= kCodes) {
        diagnosis.kind = Kind::nearly;
        diagnosis.sentence = solvedToCodes(diagnosis.fromGoal);
        return diagnosis;
    }
    compareWithAll(exercise, catalogue, codes, diagnosis);
    return diagnosis;
}

}  // namespace relief::samples::grader
