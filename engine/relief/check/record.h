// What became of one golden in a run, as a JSON file in the folder of failures: what the review page, JUnit's XML and
// `check accept` are made from. A file each, so that tests may run in processes beside each other.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "relief/check/compare.h"
#include "relief/error.h"

namespace relief {

struct GoldenRecord
{
    enum class Outcome
    {
        same,
        inRange,
        different,   // outside of the tolerance
        otherKind,   // another size, or 16 bits in place of 8
        missing,     // there is no golden
        unreadable,  // the golden, or the picture, is no picture
        unused       // a golden, and nobody draws its picture
    };

    std::string name;  // "shadows/soft_edges", without ending
    Outcome outcome = Outcome::same;
    std::string golden, actual, difference;  // files; empty where there is none
    std::string actualHash;                  // 16 digits: of the bytes of that file
    std::uint64_t differing = 0, largest = 0, window8x8 = 0;
    std::string range;     // the tolerance as text, empty where nothing may differ
    std::string message;   // lines for a person; empty where the golden is met
    bool updated = false;  // --update has made the picture the golden

    bool passes() const { return outcome <= Outcome::inRange; }
};

// "same", "in range", "different" ...
const char* wordOf(GoldenRecord::Outcome outcome);

// Files lie at FOLDER/NAME.json. Paths of files in the folder are written relative to it: it can be moved. An error as
// of file.h; reading, also where a file is no such record.
Expected<void> writeRecord(const std::string& folder, const GoldenRecord& record);
Expected<std::vector<GoldenRecord>> readRecords(const std::string& folder);  // in the order of their names

// Removes what the run before left of this golden: record, picture and difference.
void removeRecord(const std::string& folder, const std::string& name);

// A report that CI services show: one test case a golden.
std::string junitOf(const std::vector<GoldenRecord>& records);

// Makes the picture of this record the golden: the file's bytes, beside it and then renamed. A golden that is unused is
// removed. An error where the picture is no longer the one that was recorded, or as of file.h.
Expected<void> acceptRecord(const GoldenRecord& record);

}  // namespace relief
