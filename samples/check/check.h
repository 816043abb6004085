// The commands of `relief check`. Each returns 0, or 1 where pictures differ; an error is bad input.
#pragma once

#include <string>

#include "options.h"
#include "relief/check/record.h"
#include "relief/error.h"

namespace relief::samples::check {

Expected<int> compareFiles(const CheckOptions& options);
Expected<int> compareFolders(const CheckOptions& options);
Expected<int> review(const CheckOptions& options);
Expected<int> accept(const CheckOptions& options);

// The one that the options name.
Expected<int> run(const CheckOptions& options);

// A whole text file, through writeFileAtomically.
Expected<void> writeText(const std::string& path, const std::string& text);

extern const char* const kReviewPage;  // HTML, with "(data)" where the pictures go

}  // namespace relief::samples::check
