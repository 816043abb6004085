// The part of a stage's page that nobody types: what changed in its source since the stage before it. In a page it
// stands between two marks:
//
//     <!-- difference -->
//     ```diff
//     ...
//     ```
//     <!-- /difference -->
#pragma once

#include <optional>
#include <string>

namespace pages {

// The changed lines of two stage sources with two lines around them, as `diff -U2` shows them, without the file's head
// and without what differs in every stage: its name, title, section and news.
std::string difference(const std::string& before, const std::string& after);

// The page with a new difference between its marks; nothing if it has no marks.
std::optional<std::string> withDifference(const std::string& page, const std::string& difference);

}  // namespace pages
