// What nobody types: what changed in a stage's source since the stage before it. In the source, "// new" stands behind
// those lines; in the stage's page they stand between two marks:
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

// The second source with "// new" behind each line of its programs that is not in the first; no marks where more than
// half of it is new. clang-format may line them up.
std::string marked(const std::string& before, const std::string& after);
bool sameMarks(const std::string& source, const std::string& other);  // behind the same lines
std::string withoutMarks(const std::string& source);

// The page with a new difference between its marks; nothing if it has no marks.
std::optional<std::string> withDifference(const std::string& page, const std::string& difference);

}  // namespace pages
