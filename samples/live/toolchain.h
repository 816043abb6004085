// The compilers that live stages are compiled with, and the files that stages are in: what CMake found when the build
// was configured (found.cpp.in).
#pragma once

#include <string>
#include <vector>

#include "relief/error.h"

namespace relief::samples::live {

struct Toolchain
{
    std::string name;  // "g++" or "clang++"
    std::string path;  // of the compiler

    // The file of the precompiled headers, and what a stage is compiled with, them included.
    std::string precompiled;
    std::vector<std::string> words;

    // The same for traced stages (trace/traced_stage.h).
    std::string tracedPrecompiled;
    std::vector<std::string> tracedWords;
};

// All that CMake found, the fastest first.
const std::vector<Toolchain>& toolchains();

// The one of that name, "g++" or "clang++"; without a name, the fastest that is there. An error says what to install or
// to build.
Expected<const Toolchain*> findToolchain(const std::string& name = "");

// The fastest one with headers for traced stages.
Expected<const Toolchain*> findTracedToolchain();

struct StageSource
{
    std::string id, stem, folder, tutorial;  // of a stage of the book; a file of the user's has a stem alone
    std::string path;
};

// The stages of the book, in its order.
const std::vector<StageSource>& stageSources();

// Whether a word names a file, and not a stage of the book: it ends with .cpp.
bool namesFile(const std::string& stage);

// The file of a stage's number, name or path. An error where there is none.
Expected<StageSource> findSource(const std::string& stage);

std::string sampleFolder();  // of the sources
std::string liveFolder();    // where programs make folders for their objects
std::string linkerPath();
std::string programPath();  // of the program that has all commands and no stages

}  // namespace relief::samples::live
