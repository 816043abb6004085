// Regular expressions, in ECMAScript's grammar. <regex> takes two seconds to compile wherever it is used: that is in
// pattern.cpp alone.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace relief::samples {

// A place in a text that a pattern fits. Group 0 is all of it; groups that took no part are empty.
class Match
{
public:
    const std::string& operator[](std::size_t group) const { return groups.at(group).text; }
    std::size_t position(std::size_t group = 0) const { return groups.at(group).position; }  // in the text
    bool has(std::size_t group) const { return group < groups.size() && groups[group].tookPart; }

private:
    friend class Pattern;
    struct Group
    {
        std::string text;
        std::size_t position = 0;
        bool tookPart = false;
    };
    std::vector<Group> groups;
};

class Pattern
{
public:
    // Throws std::regex_error if it is none: for patterns that stand in the code.
    explicit Pattern(const char* expression);

    std::optional<Match> match(const std::string& text) const;  // all of the text
    std::vector<Match> find(const std::string& text) const;     // every place, from left to right
    // Every place replaced by these words, in which $1 is the first group.
    std::string replace(const std::string& text, const std::string& words) const;

private:
    struct Compiled;
    std::shared_ptr<const Compiled> compiled;
};

}  // namespace relief::samples
