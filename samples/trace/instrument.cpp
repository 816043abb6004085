#include "trace/instrument.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <string_view>
#include <vector>

namespace relief::samples::trace {

namespace {

// --- words ---

struct Token
{
    enum class Kind
    {
        name,  // keywords, too
        literal,
        symbol
    };
    Kind kind;
    std::string_view text;
    std::size_t begin;  // in the source
    int line;

    std::size_t end() const { return begin + text.size(); }
};

bool isNameStart(char c)
{
    return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_';
}
bool isNamePart(char c)
{
    return isNameStart(c) || std::isdigit(static_cast<unsigned char>(c)) != 0;
}

// Comments and the preprocessor's lines are not among the words.
std::vector<Token> tokensOf(std::string_view text)
{
    static constexpr std::string_view kSymbols[] = {"<<=", ">>=", "...", "->*", "::", "->", "++", "--",
                                                    "+=",  "-=",  "*=",  "/=",  "%=", "&=", "|=", "^=",
                                                    "==",  "!=",  "<=",  ">=",  "&&", "||", "<<"};
    std::vector<Token> tokens;
    int line = 1;
    bool isLineStart = true;
    for (std::size_t i = 0; i < text.size();) {
        const char c = text[i];
        if (c == '\n') {
            ++line;
            ++i;
            isLineStart = true;
            continue;
        }
        if (std::isspace(static_cast<unsigned char>(c)) != 0) {
            ++i;
            continue;
        }
        std::size_t end = i + 1;
        auto kind = Token::Kind::symbol;
        bool isWord = true;
        if (text.substr(i, 2) == "//") {
            end = std::min(text.find('\n', i), text.size());
            isWord = false;
        } else if (text.substr(i, 2) == "/*") {
            const std::size_t close = text.find("*/", i + 2);
            end = close == std::string_view::npos ? text.size() : close + 2;
            isWord = false;
        } else if (c == '#' && isLineStart) {
            end = i;
            do end = std::min(text.find('\n', end + 1), text.size());
            while (end < text.size() && text[end - 1] == '\\');
            isWord = false;
        } else if (isNameStart(c)) {
            while (end < text.size() && isNamePart(text[end])) ++end;
            kind = Token::Kind::name;
            if (text.substr(i, end - i) == "R" && end < text.size() && text[end] == '"') {
                const std::size_t open = text.find('(', end);
                const std::string close = ")" + std::string(text.substr(end + 1, open - end - 1)) + "\"";
                const std::size_t found = open == std::string_view::npos ? open : text.find(close, open);
                end = found == std::string_view::npos ? text.size() : found + close.size();
                kind = Token::Kind::literal;
            }
        } else if (std::isdigit(static_cast<unsigned char>(c)) != 0 ||
                   (c == '.' && end < text.size() && std::isdigit(static_cast<unsigned char>(text[end])) != 0)) {
            while (end < text.size() && (isNamePart(text[end]) || text[end] == '.' || text[end] == '\'' ||
                                         ((text[end] == '+' || text[end] == '-') &&
                                          std::string_view("eEpP").find(text[end - 1]) != std::string_view::npos)))
                ++end;
            kind = Token::Kind::literal;
        } else if (c == '"' || c == '\'') {
            while (end < text.size() && text[end] != c) end += text[end] == '\\' ? 2 : 1;
            end = std::min(end + 1, text.size());
            kind = Token::Kind::literal;
        } else {
            for (const std::string_view symbol : kSymbols) {
                if (text.substr(i, symbol.size()) == symbol) {
                    end = i + symbol.size();
                    break;
                }
            }
        }
        if (isWord) tokens.push_back({kind, text.substr(i, end - i), i, line});
        isLineStart = false;
        line += static_cast<int>(std::count(text.begin() + static_cast<std::ptrdiff_t>(i),
                                            text.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
        i = end;
    }
    return tokens;
}

bool isAnyOf(std::string_view text, std::initializer_list<std::string_view> words)
{
    return std::find(words.begin(), words.end(), text) != words.end();
}

bool isAssignment(std::string_view text)
{
    return isAnyOf(text, {"=", "+=", "-=", "*=", "/=", "%=", "&=", "|=", "^=", "<<=", ">>="});
}

bool isTextureFunction(std::string_view text)
{
    return isAnyOf(text, {"tex2D", "tex2DWhere", "tex2Dgrad", "tex2Dlod", "tex2Dbias", "SampleCmp", "texCUBE",
                          "texCUBEgrad", "texCUBElod", "texCUBEbias"});
}

// What a value of a shader is called. A function that gives another type may give what cannot be copied.
bool isShaderType(std::string_view text)
{
    return isAnyOf(text, {"Float", "float2", "float3", "float4", "Int", "int2", "int3", "int4", "Mask", "bool2",
                          "bool3", "bool4", "float", "float3x3", "float4x4"});
}

// --- the source ---

class Instrumenter
{
public:
    Instrumenter(const std::string& source, const std::string& itsFile) : text(source), file(itsFile)
    {
        tokens = tokensOf(text);
    }

    std::string run()
    {
        for (std::size_t i = 0; i < tokens.size();) {
            const std::size_t next = declaration(i, tokens.size(), nullptr);
            i = std::max(next, i + 1);
        }
        std::string result;
        std::size_t done = 0;
        for (const auto& [position, added] : insertions) {
            result.append(text, done, position - done);
            result += added;
            done = position;
        }
        return result.append(text, done);
    }

private:
    struct Struct
    {
        std::string name;
        std::vector<std::string> fields;
        bool hasOperator = false;
    };

    // The function that statements are in.
    struct Function
    {
        std::string name;
        bool givesValue = false;
    };

    std::string_view word(std::size_t i) const { return i < tokens.size() ? tokens[i].text : std::string_view(); }
    bool isName(std::size_t i) const { return i < tokens.size() && tokens[i].kind == Token::Kind::name; }

    void insertBefore(std::size_t token, const std::string& added) { insertions.emplace(tokens[token].begin, added); }
    void insertAfter(std::size_t token, const std::string& added) { insertions.emplace(tokens[token].end(), added); }

    // The word that closes a bracket.
    std::size_t closing(std::size_t open) const
    {
        int depth = 0;
        for (std::size_t i = open; i < tokens.size(); ++i) {
            if (isAnyOf(word(i), {"(", "[", "{"})) ++depth;
            if (isAnyOf(word(i), {")", "]", "}"}) && --depth == 0) return i;
        }
        return tokens.size() - 1;
    }

    // The word that closes a template's list, or `open` where it is a comparison.
    std::size_t closingAngle(std::size_t open) const
    {
        int depth = 0;
        for (std::size_t i = open; i < tokens.size(); ++i) {
            if (word(i) == "<") ++depth;
            if (word(i) == ">" && --depth == 0) return i;
            if (isAnyOf(word(i), {";", "{", "}", "&&", "||", "=", ")"})) return open;
            if (word(i) == "(") i = closing(i);
        }
        return open;
    }

    std::string siteOf(int line, const std::string& function, const std::string& name) const
    {
        const auto quoted = [](const std::string& words) {
            std::string all = "\"";
            for (const char c : words) all += c == '"' || c == '\\' ? std::string("\\") + c : std::string(1, c);
            return all + "\"";
        };
        return "::relief::trace::Site{" + quoted(file) + "," + std::to_string(line) + "," + quoted(function) + "," +
               quoted(name) + "}";
    }
    std::string seeing(int line, const Function& function, const std::string& name, const std::string& value) const
    {
        return " ::relief::trace::see(" + siteOf(line, function.name, name) + "," + value + ");";
    }

    std::string textOf(std::size_t begin, std::size_t end) const
    {
        std::string all;
        for (std::size_t i = begin; i < end; ++i) {
            if (i > begin && isName(i) && isName(i - 1)) all += ' ';
            all += word(i);
        }
        return all;
    }

    // One declaration at a namespace's or a struct's scope; returns what comes after it.
    std::size_t declaration(std::size_t begin, std::size_t end, Struct* inside)
    {
        bool isInitialised = false, isType = false, isEnum = false, isNamespace = false, isConstant = false;
        std::size_t parameters = 0;
        std::size_t i = begin;
        while (i < end && word(i) == "[" && word(i + 1) == "[") i = closing(i) + 1;
        if (word(i) == "template") {
            if (word(i + 1) == "<") i = closingAngle(i + 1) + 1;
            if (word(i) == "requires") ++i;
        }
        const std::size_t first = i;
        for (; i < end; ++i) {
            const std::string_view w = word(i);
            if (w == ";") {
                if (inside != nullptr && parameters == 0 && !isType) addFields(first, i, *inside);
                return i + 1;
            }
            if (w == "}") return i;
            if (w == ":" && isAnyOf(word(i - 1), {"public", "private", "protected"})) return i + 1;
            if (w == "namespace" && i == first) isNamespace = true;
            if (w == "extern" && word(i + 1).substr(0, 1) == "\"") isNamespace = true;
            if (isAnyOf(w, {"struct", "class", "union"}) && parameters == 0 && i == first) isType = true;
            if (w == "enum") isEnum = true;
            if (isAnyOf(w, {"constexpr", "consteval", "decltype"})) isConstant = true;
            if (w == "=" && word(i - 1) != "operator") isInitialised = true;
            if (w == "operator" && word(i + 1) == "(") {
                i += 2;  // its name is operator()
                continue;
            }
            if (w == "<" && isName(i - 1)) i = closingAngle(i);
            if (word(i) == "(") {
                if (parameters == 0 && !isInitialised) parameters = i;
                i = closing(i);
            } else if (word(i) == "[") {
                i = closing(i);
            } else if (word(i) == "{") {
                const std::size_t close = closing(i);
                const bool isBody = parameters != 0 && !isInitialised &&
                                    (word(i - 1) == ")" || isAnyOf(word(i - 1), {"const", "noexcept", "override"}) ||
                                     hasArrow(parameters, i));
                if (isNamespace) {
                    for (std::size_t k = i + 1; k < close;) k = std::max(declaration(k, close, nullptr), k + 1);
                    return close + 1;
                }
                if (isEnum || isInitialised) {
                    i = close;
                } else if (isType) {
                    structBody(begin, first, i, close);
                    return word(close + 1) == ";" ? close + 2 : close + 1;
                } else if (isBody) {
                    if (inside != nullptr && word(parameters - 1) == ")") inside->hasOperator = true;
                    if (!isConstant) functionBody(first, parameters, i, close, inside);
                    return close + 1;
                } else {
                    i = close;
                }
            }
        }
        return end;
    }

    bool hasArrow(std::size_t parameters, std::size_t body) const
    {
        for (std::size_t i = closing(parameters); i < body; ++i) {
            if (word(i) == "->") return true;
        }
        return false;
    }

    void structBody(std::size_t begin, std::size_t first, std::size_t open, std::size_t close)
    {
        std::size_t i = first + 1;
        while (word(i) == "alignas" || word(i) == "[") i = closing(word(i) == "[" ? i : i + 1) + 1;
        std::size_t nameEnd = i;
        while (nameEnd < open && word(nameEnd) != ":") ++nameEnd;
        if (nameEnd > i && word(nameEnd - 1) == "final") --nameEnd;
        Struct its{.name = textOf(i, nameEnd), .fields = {}, .hasOperator = false};
        const bool isTemplate = word(begin) == "template" && word(begin + 2) != ">";
        ++depthOfStructs;
        for (std::size_t k = open + 1; k < close;) k = std::max(declaration(k, close, &its), k + 1);
        --depthOfStructs;
        if (isTemplate || its.name.empty() || its.hasOperator || its.fields.empty() || depthOfStructs > 0 ||
            word(first) == "class" || word(close + 1) != ";")
            return;
        std::string function = " [[maybe_unused]] inline void seeFields(const ::relief::trace::Fields& fields, const " +
                               its.name + "& its) {";
        for (const std::string& field : its.fields) function += " fields(\"" + field + "\", its." + field + ");";
        insertAfter(close + 1, function + " }");
    }

    // The names of a struct's fields in `Type a, b = 1, c{2}`.
    void addFields(std::size_t begin, std::size_t end, Struct& to)
    {
        if (end - begin < 2 || isAnyOf(word(begin), {"using", "static", "friend", "typedef", "enum", "public",
                                                     "private", "static_assert"}))
            return;
        for (const std::size_t name : declarators(begin, end, false)) to.fields.emplace_back(word(name));
    }

    // The names that a declaration declares; only those with a value where `initialised`.
    std::vector<std::size_t> declarators(std::size_t begin, std::size_t end, bool initialised) const
    {
        std::vector<std::size_t> names;
        bool wantsName = true;
        for (std::size_t i = begin; i < end; ++i) {
            if (word(i) == "<" && i > begin && isName(i - 1)) i = closingAngle(i);
            if (isAnyOf(word(i), {"(", "[", "{"})) {
                i = closing(i);
                continue;
            }
            if (word(i) == ",") wantsName = true;
            if (!wantsName || !isName(i)) continue;
            const std::string_view next = word(i + 1);
            const bool isEnd = i + 1 == end || next == ",";
            const bool hasValue = isAnyOf(next, {"=", "{", "("}) && i + 1 < end;
            if (!isEnd && !hasValue) continue;
            if (i == begin) return {};
            wantsName = false;
            if (hasValue || !initialised) names.push_back(i);
        }
        return names;
    }

    void functionBody(std::size_t first, std::size_t parameters, std::size_t open, std::size_t close, const Struct* in)
    {
        const bool isOperator = word(parameters - 1) == ")";  // operator()
        std::size_t name = isOperator ? parameters - 3 : parameters - 1;
        if (!isName(name)) return statements(open + 1, close, {});
        const std::string words(word(name));
        if (words == "operator" && !isOperator) return statements(open + 1, close, {});
        Function function;
        function.name = isOperator && in != nullptr ? in->name : words;
        for (std::size_t i = first; i < name; ++i) function.givesValue |= i + 1 == name && isShaderType(word(i));
        const int line = tokens[name].line;
        std::string added = " ::relief::trace::Call relief_call(" + siteOf(line, function.name, function.name) + ");";
        const std::size_t last = closing(parameters);
        for (std::size_t begin = parameters + 1; begin < last;) {
            std::size_t end = begin;
            bool isReference = false, isFixed = false;
            std::size_t value = 0;
            for (; end < last && word(end) != ","; ++end) {
                if (word(end) == "<" && isName(end - 1)) end = closingAngle(end);
                if (isAnyOf(word(end), {"(", "[", "{"})) end = closing(end);
                isReference |= isAnyOf(word(end), {"&", "&&", "*"});
                isFixed |= word(end) == "const";
                if (word(end) == "=" && value == 0) value = end;
            }
            const std::size_t after = value != 0 ? value : end;
            const bool isNamed = after - begin >= 2 && isName(after - 1) && word(after - 1) != "const";
            // What is given by a reference that is not const may have no value yet.
            if (isNamed && (!isReference || isFixed)) {
                const std::string its(word(after - 1));
                added += seeing(tokens[after - 1].line, function, its, its);
            }
            begin = end + 1;
        }
        insertAfter(open, added);
        statements(open + 1, close, function);
    }

    void statements(std::size_t begin, std::size_t end, const Function& function)
    {
        for (std::size_t i = begin; i < end;) i = std::max(statement(i, end, function, false), i + 1);
    }

    // `embedded`: the one statement of an if or a loop without braces. Returns what comes after it.
    std::size_t statement(std::size_t i, std::size_t end, const Function& function, bool embedded)
    {
        const std::string_view w = word(i);
        if (w == "{") {
            const std::size_t close = closing(i);
            statements(i + 1, close, function);
            return close + 1;
        }
        if (isAnyOf(w, {"if", "while", "switch", "for"})) {
            std::size_t open = i + 1;
            if (word(open) == "constexpr") ++open;
            const std::size_t close = closing(open);
            expressions(open + 1, close, function);
            return statement(close + 1, end, function, true);
        }
        if (isAnyOf(w, {"else", "do"})) return statement(i + 1, end, function, true);
        if (isAnyOf(w, {"case", "default"})) {
            while (i < end && word(i) != ":") ++i;
            return i + 1;
        }
        std::size_t last = i;
        for (; last < end && word(last) != ";"; ++last) {
            if (isAnyOf(word(last), {"(", "[", "{"})) last = closing(last);
        }
        if (isAnyOf(w, {"struct", "class", "enum", "union", "using", "typedef", "static_assert", "break", "continue",
                        "goto", ";"}))
            return last + 1;
        expressions(i, last, function);
        if (w == "return") {
            if (function.givesValue && last > i + 1 && word(i + 1) != "{") {
                insertAfter(i, " ::relief::trace::returned(" + siteOf(tokens[i].line, function.name, "return") + ",");
                insertBefore(last, ")");
            }
            return last + 1;
        }
        std::string added;
        for (const auto& [name, line] : assigned(i, last)) added += seeing(line, function, name, name);
        if (!added.empty() && last < end) {
            if (embedded) insertBefore(i, "{ ");
            insertAfter(last, added + (embedded ? " }" : ""));
        }
        return last + 1;
    }

    // Whether these words are one thing that can be assigned to: i.normal, a[2].x.
    bool isPlace(std::size_t begin, std::size_t end) const
    {
        for (std::size_t i = begin; i < end; ++i) {
            if (word(i) == "[" && i > begin) {
                i = closing(i);
            } else if (isName(i)) {
                if (i > begin && !isAnyOf(word(i - 1), {".", "->", "::"})) return false;
            } else if (!isAnyOf(word(i), {".", "->", "::"})) {
                return false;
            }
        }
        return end > begin && isName(begin);
    }

    struct Assigned
    {
        std::string name;
        int line;
    };

    // What a statement gives a value.
    std::vector<Assigned> assigned(std::size_t begin, std::size_t end) const
    {
        if (isAnyOf(word(begin), {"static", "constexpr", "throw", "delete", "co_return"})) return {};
        if (isAnyOf(word(begin), {"++", "--"}) && isPlace(begin + 1, end))
            return {{textOf(begin + 1, end), tokens[begin].line}};
        if (end > begin && isAnyOf(word(end - 1), {"++", "--"}) && isPlace(begin, end - 1))
            return {{textOf(begin, end - 1), tokens[begin].line}};
        std::size_t i = begin;
        for (; i < end && !isAssignment(word(i)); ++i) {
            if (word(i) == "<" && i > begin && isName(i - 1)) i = closingAngle(i);
            if (isAnyOf(word(i), {"(", "{"})) i = closing(i);
            if (word(i) == "[" && i > begin && word(i - 1) != "auto" && word(i - 1) != "&") i = closing(i);
        }
        if (i < end && isPlace(begin, i)) return {{textOf(begin, i), tokens[begin].line}};
        std::vector<Assigned> all;
        if (i < end && word(i) == "=" && word(i - 1) == "]") {
            // const auto& [a, b] = ...;
            std::size_t open = i - 1;
            while (open > begin && word(open) != "[") --open;
            if (word(open - 1) != "auto" && word(open - 1) != "&") return {};
            for (std::size_t k = open + 1; k + 1 < i; ++k) {
                if (isName(k)) all.push_back({std::string(word(k)), tokens[k].line});
            }
            return all;
        }
        // A declaration has at least two words before the name's value; a call has one.
        for (const std::size_t name : declarators(begin, end, true)) {
            const bool afterSymbol = name > begin + 1 && isAnyOf(word(name - 1), {">", "&", "*", ","});
            const bool hasType = afterSymbol || (name > begin && isName(name - 1));
            if (!hasType) return all;
            all.push_back({std::string(word(name)), tokens[name].line});
        }
        return all;
    }

    // Samples of textures, and the bodies of lambdas.
    void expressions(std::size_t begin, std::size_t end, const Function& function)
    {
        for (std::size_t i = begin; i < end; ++i) {
            const std::string_view before = i > 0 ? word(i - 1) : std::string_view();
            if (isTextureFunction(word(i)) && word(i + 1) == "(" && !isAnyOf(before, {".", "->", "::"})) {
                insertBefore(i, "::relief::trace::");
                insertAfter(i + 1, siteOf(tokens[i].line, function.name, std::string(word(i))) + ", ");
            }
            if (word(i) != "[") continue;
            if (word(i + 1) == "[" || before == ")" || before == "]" || (isName(i - 1) && before != "return")) {
                continue;  // an attribute, an element
            }
            std::size_t k = closing(i) + 1;
            if (word(k) == "<") k = closingAngle(k) + 1;
            const std::size_t parameters = k;
            if (word(k) == "(") k = closing(k) + 1;
            while (k < end && word(k) != "{" && !isAnyOf(word(k), {",", ";", ")"})) {
                k = word(k) == "(" ? closing(k) + 1 : k + 1;
            }
            if (k >= end || word(k) != "{") continue;
            const std::size_t close = closing(k);
            statements(k + 1, close, {function.name, k > parameters + 1 && isShaderType(word(k - 1))});
            i = close;
        }
    }

    const std::string& text;
    const std::string& file;
    std::vector<Token> tokens;
    std::multimap<std::size_t, std::string> insertions;  // by place in the text; several in the order that they came
    int depthOfStructs = 0;
};

}  // namespace

std::string instrumented(const std::string& text, const std::string& file)
{
    return Instrumenter(text, file).run();
}

}  // namespace relief::samples::trace
