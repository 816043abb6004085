// Whole files in and out, by paths in UTF-8. What enters and leaves is bytes; what they mean is the business of
// texture/image.h and mesh/obj.h. Every error is one line that names the file, what is wrong with it and the remedy.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "relief/error.h"

namespace relief {

inline constexpr std::uint64_t kMaxFileBytes = std::uint64_t{1} << 30;  // 1 GiB: stb counts a file's bytes in an int

// Every byte of a regular file. An error when it is missing, not readable, a directory or a device, empty, or longer
// than kMaxFileBytes or the memory that is left.
Expected<std::vector<std::uint8_t>> readFile(const std::string& name);

// The same as a string.
Expected<std::string> readText(const std::string& name);

// Writes the bytes to a temporary file in the folder of `name` and then renames it, so that a reader sees the old file
// or the new one and never a part; a symbolic link keeps pointing at the file it names. An error when the folder is
// missing or read-only, the disk is full, or `name` exists and is no regular file; nothing is left behind then.
Expected<void> writeFileAtomically(const std::string& name, std::span<const std::uint8_t> bytes);

}  // namespace relief
