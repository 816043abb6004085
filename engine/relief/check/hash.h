// One number for what a target holds: the same on every machine, for any number of threads and lanes and any tile size.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "relief/pipeline/framebuffer.h"

namespace relief {

// A 64-bit hash (FNV-1a over 32-bit words) of everything that a target keeps, one attachment after the other.
std::uint64_t hashOf(const Framebuffer& target);

// The same over bytes: of a file.
std::uint64_t hashOf(std::span<const std::uint8_t> bytes);

// 16 hexadecimal digits.
std::string hexadecimal(std::uint64_t hash);

}  // namespace relief
