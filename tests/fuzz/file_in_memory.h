// A file that exists in memory only, with a name to open it by: what the readers of files are given.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include <sys/mman.h>
#include <unistd.h>

struct FileInMemory
{
    FileInMemory(const std::uint8_t* data, std::size_t size) : descriptor(memfd_create("fuzz", 0))
    {
        while (size > 0) {
            const ssize_t written = write(descriptor, data, size);
            if (written <= 0) break;
            data += written;
            size -= static_cast<std::size_t>(written);
        }
    }
    ~FileInMemory() { close(descriptor); }
    FileInMemory(const FileInMemory&) = delete;
    FileInMemory& operator=(const FileInMemory&) = delete;

    std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor); }

    int descriptor;
};
