// The stages of the book as a window lists them: what their files' first lines say, their pages and their pictures.
#pragma once

#include <string>
#include <vector>

#include "live/toolchain.h"

namespace relief::samples {

struct Listed
{
    live::StageSource source;
    std::string title, news;
};

// In the book's order. Read from the sources once.
const std::vector<Listed>& listedStages();

// Whether each word of `search` is in the number, title, lesson or tutorial of a stage; capitals do not matter.
bool matches(const Listed& stage, const std::string& search);

// Files of a stage of the book; they may not be there, where the sources are not.
std::string pageOf(const live::StageSource& source);
std::string goldenOf(const live::StageSource& source);

}  // namespace relief::samples
