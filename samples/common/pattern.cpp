#include "common/pattern.h"

#include <regex>

namespace relief::samples {

struct Pattern::Compiled
{
    std::regex regex;

    static Match matchOf(const std::smatch& m)
    {
        Match match;
        for (std::size_t i = 0; i < m.size(); ++i)
            match.groups.push_back({m[i].str(), static_cast<std::size_t>(m.position(i)), m[i].matched});
        return match;
    }
};

Pattern::Pattern(const char* expression) : compiled(std::make_shared<Compiled>(Compiled{std::regex(expression)})) {}

std::optional<Match> Pattern::match(const std::string& text) const
{
    std::smatch m;
    if (!std::regex_match(text, m, compiled->regex)) return std::nullopt;
    return Compiled::matchOf(m);
}

std::vector<Match> Pattern::find(const std::string& text) const
{
    std::vector<Match> all;
    for (std::sregex_iterator m(text.begin(), text.end(), compiled->regex), end; m != end; ++m)
        all.push_back(Compiled::matchOf(*m));
    return all;
}

std::string Pattern::replace(const std::string& text, const std::string& words) const
{
    return std::regex_replace(text, compiled->regex, words);
}

}  // namespace relief::samples
