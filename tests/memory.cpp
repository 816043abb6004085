// Small inputs that ask for much memory: an error where there is none, and no end of the program.
#include "relief/memory.h"

#include <csignal>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <doctest/doctest.h>

#include "relief/file.h"
#include "relief/mesh/bake.h"
#include "relief/mesh/primitives.h"
#include "relief/mesh/tangents.h"
#include "relief/texture/image.h"
#include "relief/texture/texture.h"
#include "temporary_folder.h"

using namespace relief;

namespace {

constexpr std::uint64_t kMiB = 1 << 20;

// Sanitizers take terabytes of addresses for themselves.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kCanLimit = false;
#elif defined(__has_feature)
constexpr bool kCanLimit = !__has_feature(address_sanitizer) && !__has_feature(thread_sanitizer);
#else
constexpr bool kCanLimit = true;
#endif

// What the call says in a process that has no more memory: 1 for yes, 0 for no, -1 where the process did not live to
// say it.
int saysWithin(std::uint64_t bytes, const std::function<bool()>& call)
{
    const pid_t child = fork();
    if (child == 0) {
        const rlimit limit{bytes, bytes};
        if (setrlimit(RLIMIT_AS, &limit) != 0) _exit(77);
        std::signal(SIGABRT, SIG_DFL);                            // not the test program's
        const auto says = [&call]() noexcept { return call(); };  // an exception ends the process
        _exit(says() ? 1 : 0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) && WEXITSTATUS(status) <= 1 ? WEXITSTATUS(status) : -1;
}

template <class T>
bool speaksOfMemory(const Expected<T>& result)
{
    return !result && result.error().message.find("fit into memory; ") != std::string::npos;
}

}  // namespace

TEST_CASE("memory: whether a block can be had")
{
    CHECK(fitsInMemory(0));
    CHECK(fitsInMemory(kMiB));
    CHECK_FALSE(fitsInMemory(~std::uint64_t{0}));
    CHECK_FALSE(fitsInMemory(std::uint64_t{1} << 60));
    if (kCanLimit) CHECK(saysWithin(512 * kMiB, [] { return fitsInMemory(1024 * kMiB); }) == 0);
}

TEST_CASE("memory: the largest terrain fits into 1 GiB" * doctest::skip(!kCanLimit))
{
    CHECK(saysWithin(1024 * kMiB, [] { return makeTerrain(4096, 4096).indices.size() == std::size_t{6} << 23; }) == 1);
}

TEST_CASE("memory: textures, maps and files that are too large for it" * doctest::skip(!kCanLimit))
{
    const auto never = [](int, const MipLevel*) { return MipLevel(TexelFormat::rgba8, 1, 1); };
    CHECK(saysWithin(1024 * kMiB, [&] {
              return speaksOfMemory(Texture::fromLevels(TexelFormat::rgba32Float, 16384, 16384, never));
          }) == 1);
    const std::vector<std::uint8_t> rgba(std::size_t{4096} * 4096 * 4);  // 64 MiB, and twice as much in linear light
    CHECK(saysWithin(224 * kMiB,
                     [&] { return speaksOfMemory(Texture::fromRgba8(4096, 4096, rgba, ColorSpace::srgb)); }) == 1);

    const Mesh quad = *withTangents(makeQuad());
    CHECK(saysWithin(1024 * kMiB, [&] {
              return speaksOfMemory(bakeNormalMap(quad, quad, {.width = 16384, .height = 16384}));
          }) == 1);

    const TemporaryFolder folder;
    const std::filesystem::path sparse = folder.write("sparse.png", "x");
    std::filesystem::resize_file(sparse, 900 * kMiB);
    CHECK(saysWithin(512 * kMiB, [&] { return speaksOfMemory(readFile(sparse)); }) == 1);

    // 8192 x 8192 grey pixels in packets of 128: 64 MiB in the decoder, 256 as RGBA, and as much again.
    std::string runs = {0, 0, 11, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 32, 0, 32, 8, 0};
    for (int packet = 0; packet < 8192 * 8192 / 128; ++packet) runs += "\xff\x40";
    const std::filesystem::path tga = folder.write("runs.tga", runs);
    CHECK(saysWithin(480 * kMiB, [&] { return speaksOfMemory(readImage(tga)); }) == 1);
    CHECK(saysWithin(240 * kMiB, [&] { return speaksOfMemory(readImage(tga)); }) == 1);
}
