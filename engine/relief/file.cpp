// Whole files in and out, by the C library's streams, whose errno says why a call failed.
#include "relief/file.h"

#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <memory>
#include <string>
#include <system_error>
#include <utility>

#if defined(_WIN32)
#include <fcntl.h>
#include <io.h>
#include <sys/stat.h>
#endif

#include "relief/memory.h"
#include "relief/path.h"

namespace relief {
namespace {

namespace fs = std::filesystem;

struct Close
{
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Close>;

std::string systemReason(int error)
{
    return std::generic_category().message(error);
}

// Windows' fopen takes names in the user's code page, which lacks most letters, and ignores "x" in the mode.
#if defined(_WIN32)
File openToRead(const fs::path& path)
{
    return File(_wfopen(path.c_str(), L"rb"));
}

File createNew(const fs::path& path)
{
    const int descriptor = _wopen(path.c_str(), _O_WRONLY | _O_CREAT | _O_EXCL | _O_BINARY, _S_IREAD | _S_IWRITE);
    return File(descriptor < 0 ? nullptr : _fdopen(descriptor, "wb"));
}
#else
File openToRead(const fs::path& path)
{
    return File(std::fopen(path.c_str(), "rb"));
}

File createNew(const fs::path& path)
{
    return File(std::fopen(path.c_str(), "wbx"));
}
#endif

struct Temporary
{
    File file;
    fs::path path;
    int error = 0;  // errno of the last attempt where `file` is null
};

// A new file that no other thread or process has: creating it fails where the name is taken. Unlike mkstemp this leaves
// the permissions to the user's umask. The name is short, so that a long target name cannot make it too long.
Temporary createTemporary(const fs::path& folder)
{
    constexpr int kAttempts = 10000;
    Temporary temporary;
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
        temporary.path = folder / (".relief-" + std::to_string(attempt) + ".partial");
        temporary.file = createNew(temporary.path);
        temporary.error = temporary.file ? 0 : errno;
        if (temporary.error != EEXIST) break;
    }
    return temporary;
}

// Returns 0, or the errno of what failed. A full disk may show only when the last buffer is flushed.
int writeAndClose(File file, std::span<const std::uint8_t> bytes)
{
    int error = 0;
    if (std::fwrite(bytes.data(), 1, bytes.size(), file.get()) != bytes.size()) error = errno;
    if (std::fclose(file.release()) != 0 && error == 0) error = errno;
    return error;
}

}  // namespace

Expected<std::vector<std::uint8_t>> readFile(const std::string& name)
{
    const fs::path path = pathOf(name);
    std::error_code code;
    const fs::file_status status = fs::status(path, code);
    if (fs::is_directory(status)) return fail(name + ": is a directory; name a file in it");
    if (fs::exists(status) && !fs::is_regular_file(status)) return fail(name + ": is not a regular file; name one");

    const File file = openToRead(path);
    if (!file) return fail(name + ": cannot open (" + systemReason(errno) + "); check the path");

    const std::uintmax_t size = fs::file_size(path, code);
    if (code) return fail(name + ": cannot read (" + code.message() + "); check the disk");
    if (size == 0) return fail(name + ": is empty; export or copy it again");
    if (size > kMaxFileBytes) {
        return fail(name + ": its " + std::to_string(size) + " bytes are more than 1 GiB; make it smaller");
    }
    if (!fitsInMemory(size)) {
        return fail(name + ": its " + std::to_string(size) + " bytes do not fit into memory; make it smaller");
    }
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(size));
    if (std::fread(bytes.data(), 1, bytes.size(), file.get()) != bytes.size()) {
        return fail(name + ": cannot read all of it; check that nothing else is writing to it");
    }
    return bytes;
}

Expected<std::string> readText(const std::string& name)
{
    return readFile(name).map(
        [](const std::vector<std::uint8_t>& bytes) { return std::string(bytes.begin(), bytes.end()); });
}

Expected<void> writeFileAtomically(const std::string& name, std::span<const std::uint8_t> bytes)
{
    const fs::path path = pathOf(name);
    std::error_code code;
    const fs::file_status status = fs::status(path, code);
    if (fs::is_directory(status) || !path.has_filename()) return fail(name + ": is a directory; name a file in it");
    // Renaming over a device would replace the device.
    if (fs::exists(status) && !fs::is_regular_file(status)) {
        return fail(name + ": is not a regular file; write to another path");
    }
    fs::path target = path;
    if (fs::is_symlink(fs::symlink_status(path, code))) {
        const fs::path resolved = fs::canonical(path, code);
        if (code) return fail(name + ": is a broken link (" + code.message() + "); remove it");
        target = resolved;
    }
    const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
    if (!fs::is_directory(folder, code)) return fail(name + ": its folder does not exist; create it");

    Temporary temporary = createTemporary(folder);
    if (!temporary.file) {
        return fail(name + ": cannot write in its folder (" + systemReason(temporary.error) + "); choose another one");
    }
    if (const int error = writeAndClose(std::move(temporary.file), bytes)) {
        fs::remove(temporary.path, code);
        return fail(name + ": cannot write (" + systemReason(error) + "); free some space or choose another folder");
    }
    std::error_code renamed;
    fs::rename(temporary.path, target, renamed);
    if (renamed) {
        fs::remove(temporary.path, code);
        return fail(name + ": cannot replace (" + renamed.message() + "); check its permissions");
    }
    return {};
}

}  // namespace relief
