// What a compiler says, in the learner's words: where in his own file, and first what Relief's own checks say.
#pragma once

#include <string>
#include <vector>

namespace relief::samples::live {

struct Diagnostic
{
    std::string file;          // the learner's, where the compiler names it at all; else another one's
    int line = 0, column = 0;  // from 1; 0: none
    std::string message;       // in plain words, types as they are written in a stage
    std::string source;        // the line's text; empty: not known
    bool fromCheck = false;    // one of the engine's own sentences (checkPrograms in pipeline/program.h)
};

// The errors in what a compiler printed: sentences of the engine's checks first, then the others in their order. `path`
// and `text` are the learner's file.
std::vector<Diagnostic> parseDiagnostics(const std::string& output, const std::string& path, const std::string& text);

// As it stands on the terminal and in the window: the place and the message, the line, a mark under it.
std::string formatted(const Diagnostic& diagnostic);
std::string formatted(const std::vector<Diagnostic>& diagnostics);

}  // namespace relief::samples::live
