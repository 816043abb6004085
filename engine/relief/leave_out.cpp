// The words of RELIEF_GENERIC.
#include "relief/leave_out.h"

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <string>

namespace relief::leavesOut {

namespace {

// Takes the first word away from `words` and returns it; empty if there is none.
std::string_view takeWord(std::string_view& words)
{
    words.remove_prefix(std::min(words.find_first_not_of(' '), words.size()));
    const std::string_view word = words.substr(0, words.find(' '));
    words.remove_prefix(word.size());
    return word;
}

}  // namespace

std::string_view generic()
{
#if defined(RELIEF_SWITCHES)
    if (const char* const words = std::getenv("RELIEF_GENERIC")) return words;
#endif
    return "";
}

bool putsBack(std::string_view words, std::string_view name)
{
    for (std::string_view word = takeWord(words); !word.empty(); word = takeWord(words)) {
        if (word == name || word == "all") return true;
    }
    return false;
}

Expected<void> checkGeneric(std::string_view words)
{
    std::string names;
    for (const LeftOut& left : kAll) names += std::string(left.name) + " ";
    for (std::string_view word = takeWord(words); !word.empty(); word = takeWord(words)) {
        const auto isPutBack = [word](const LeftOut& left) { return putsBack(word, left.name); };
        if (std::none_of(std::begin(kAll), std::end(kAll), isPutBack)) {
            return fail("RELIEF_GENERIC: nothing named " + std::string(word) + " is left out; use words of: " + names +
                        "all");
        }
    }
    return {};
}

}  // namespace relief::leavesOut
