#include "grader/mutate.h"

#include <set>

#include "common/pattern.h"

namespace relief::samples::grader {

namespace {

// What mutates the text of one gap.
struct Mutator
{
    const std::string& gap;
    std::size_t offset;  // of the gap in the text
    std::vector<Mutation>& all;

    void add(const char* kind, std::size_t at, std::size_t size, const std::string& to)
    {
        if (gap.substr(at, size) == to) return;
        all.push_back({kind, {offset + at, offset + at + size}, to});
    }

    template <class Function>
    void each(const char* pattern, const Function& function)
    {
        for (const Match& m : Pattern(pattern).find(gap)) function(m);
    }

    void operators();
    void numbers();
    void swizzles();
    void calls();
    void names();
    void statements();
};

void Mutator::operators()
{
    static const std::pair<char, char> kOthers[] = {{'+', '-'}, {'-', '+'}, {'*', '/'}, {'/', '*'}, {'<', '>'}};
    each(" ([-+*/<]=?) ", [&](const Match& m) {
        for (const auto& [is, other] : kOthers) {
            std::string to = m[1];
            if (to[0] != is) continue;
            to[0] = other;
            add("operator", m.position(1), m[1].size(), to);
        }
    });
}

void Mutator::numbers()
{
    each("\\b\\d+(\\.\\d+f)?\\b", [&](const Match& m) {
        if (m.position() > 0 && (std::isalnum(static_cast<unsigned char>(gap[m.position() - 1])) != 0)) return;
        for (const char* to : {"0.0f", "1.0f", "0.5f", "2.0f"}) add("number", m.position(), m[0].size(), to);
        add("number", m.position(), m[0].size(), "-" + m[0]);
    });
}

void Mutator::swizzles()
{
    each("\\.([xyzw]{1,4})\\b", [&](const Match& m) {
        const std::string is = m[1];
        for (std::size_t i = 0; i + 1 < is.size(); ++i) {
            std::string to = is;
            std::swap(to[i], to[i + 1]);
            add("swizzle", m.position(1), m[1].size(), to);
        }
        for (const char c : {'x', 'y', 'z'}) {
            std::string to = is;
            to.back() = c;
            add("swizzle", m.position(1), m[1].size(), to);
        }
    });
}

void Mutator::calls()
{
    each("\\b(normalize|saturate|abs|sqrt|transpose|ddx|ddy)\\(",
         [&](const Match& m) { add("call left out", m.position(1), m[1].size(), ""); });
    each("\\b\\w+\\(([^(),]+), ([^(),]+)\\)",
         [&](const Match& m) { add("arguments", m.position(1), m[1].size() + 2 + m[2].size(), m[2] + ", " + m[1]); });
    each("\\b(cross|dot|mul)\\(", [&](const Match& m) {
        for (const char* to : {"cross", "dot", "mul", "reflect", "max", "min"})
            add("function", m.position(1), m[1].size(), to);
    });
}

void Mutator::names()
{
    std::set<std::string> names;
    const char* const pattern = "\\b[a-z]\\w*(?:\\.[a-z]\\w{2,})?\\b(?!\\(|::)";
    static const std::set<std::string> kWords = {"const",    "float2", "float3",    "float4",
                                                 "float3x3", "if",     "constexpr", "f"};
    each(pattern, [&](const Match& m) {
        if (kWords.count(m[0]) == 0) names.insert(m[0]);
    });
    each(pattern, [&](const Match& m) {
        if (kWords.count(m[0]) != 0) return;
        for (const std::string& name : names) add("name", m.position(), m[0].size(), name);
        add("minus", m.position(), 0, "-");
    });
}

void Mutator::statements()
{
    each("( *)([^\\n;]*;)\\n", [&](const Match& m) {
        const bool isDeclaration = m[2].starts_with("const ");
        if (!isDeclaration) add("statement left out", m.position(2), m[2].size(), "");
    });
}

}  // namespace

std::string Mutation::applied(const std::string& text) const
{
    std::string changed = text;
    return changed.replace(span.begin, span.end - span.begin, to);
}

std::vector<Mutation> mutationsOf(const std::string& text)
{
    std::vector<Mutation> all;
    for (const Span& span : gapsOf(text)) {
        const std::string gap = text.substr(span.begin, span.end - span.begin);
        Mutator mutator{gap, span.begin, all};
        mutator.operators();
        mutator.numbers();
        mutator.swizzles();
        mutator.calls();
        mutator.names();
        mutator.statements();
    }
    return all;
}

}  // namespace relief::samples::grader
