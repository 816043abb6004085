// A stage with many programs is compiled by several compilers at once: each reads the whole file, and makes code for
// its part of the programs alone. Their objects are linked into one, where a draw finds its programs by their names.
//
// Part is defined in the file that is compiled, before the learner's first line (compile.cpp):
//
//     template <class Any>
//     struct Part
//     {
//         static constexpr unsigned kNumber = 0;               // of this compiler
//         static constexpr unsigned owner(std::uint64_t id);   // the part that a pair of programs is compiled in
//     };
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "live/compiled_programs.h"

namespace relief::inline RELIEF_WIDTH::detail {

template <class Any>
struct Part;

// Hidden: each object has its own.
[[gnu::visibility("hidden")]] inline const CompiledPrograms* compiledPrograms = nullptr;

inline CompiledPrograms::CompiledPrograms(std::uint64_t itsId, const Programs& its)
    : id(itsId), programs(&its), next(compiledPrograms)
{
    compiledPrograms = this;
}

inline const Programs& findPrograms(std::uint64_t id)
{
    for (const CompiledPrograms* p = compiledPrograms; p != nullptr; p = p->next) {
        if (p->id == id) return *p->programs;
    }
    std::fputs("relief: a pair of programs is in none of the parts that were compiled\n", stderr);
    std::abort();
}

// FNV-1a of the pair's name. Two lambdas can have the same one: such a file is not divided.
template <class VertexProgram, class FragmentProgram>
consteval std::uint64_t idOfPrograms()
{
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (const char* c = __PRETTY_FUNCTION__; *c != '\0'; ++c) {
        hash = (hash ^ static_cast<unsigned char>(*c)) * 0x100000001b3u;
    }
    return hash;
}

template <class VertexProgram, class FragmentProgram>
struct CompiledHere
{
    static inline const CompiledPrograms entry{idOfPrograms<VertexProgram, FragmentProgram>(),
                                               kPrograms<VertexProgram, FragmentProgram>};
};

template <class VertexProgram, class FragmentProgram>
const Programs& programsOf()
{
    constexpr std::uint64_t id = idOfPrograms<VertexProgram, FragmentProgram>();
    if constexpr (Part<VertexProgram>::owner(id) == Part<VertexProgram>::kNumber) {
        return *CompiledHere<VertexProgram, FragmentProgram>::entry.programs;
    } else {
        return findPrograms(id);
    }
}

}  // namespace relief::inline RELIEF_WIDTH::detail
