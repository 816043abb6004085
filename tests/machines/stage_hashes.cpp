// One machine's bits: every stage as floats, held to the committed hash. Where one differs, the same program on two
// machines names the first pixel, and writes its life on each.
//
//   stage_hashes [STAGE...]             asserts the hashes of these stages, or of all
//   stage_hashes words STAGE FILE       writes all that the stage's target holds
//   stage_hashes compare STAGE FILE     the first pixel that differs from such a file of another machine; prints X,Y
//   stage_hashes trace STAGE X,Y FILE   writes the life of that pixel
//   stage_hashes time STAGE             milliseconds a frame, one thread, 640x360, the least of twenty
//   stage_hashes names FOLDER           writes, reads and replaces files whose names have letters of many languages
#include <charconv>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <map>

#include "golden_stage.h"
#include "relief/file.h"
#include "relief/path.h"
#include "relief/trace/pixel_trace.h"
#include "trace/tell.h"

namespace {

using namespace relief;
using namespace relief::samples;

using Arguments = std::vector<std::string>;

Expected<std::map<std::string, std::string>> committedHashes()
{
    std::ifstream file(hashesPath());
    std::map<std::string, std::string> hashes;
    std::string hash, id, stem;
    while (file >> hash >> id >> stem) hashes[id] = hash;
    if (hashes.size() == allStages().size()) return hashes;
    return fail(hashesPath().string() + ": has " + std::to_string(hashes.size()) + " hashes for " +
                std::to_string(allStages().size()) + " stages; run update_goldens");
}

Expected<void> assertHashes(const Arguments& names)
{
    const auto hashes = committedHashes();
    if (!hashes) return tl::unexpected(hashes.error());
    std::vector<const Stage*> stages;
    for (const std::string& name : names) {
        const Expected<const Stage*> stage = findStage(name);
        if (!stage) return tl::unexpected(stage.error());
        stages.push_back(*stage);
    }
    if (names.empty()) {
        for (const Stage& stage : allStages()) stages.push_back(&stage);
    }
    std::size_t same = 0;
    for (const Stage* stage : stages) {
        const Expected<Framebuffer> target = renderForGolden(*stage, Format::rgba32f);
        if (!target) return tl::unexpected(target.error());
        const std::string hash = hexadecimal(hashOf(*target)), expected = hashes->at(stage->id);
        if (hash == expected) {
            ++same;
        } else {
            std::printf("differs %s: hash %s, should be %s\n", stage->id.c_str(), hash.c_str(), expected.c_str());
        }
    }
    std::printf("%zu of %zu hashes, %d lanes\n", same, stages.size(), kLanes);
    return same == stages.size() ? Expected<void>() : fail("the bits are not those of tests/golden/hashes.txt");
}

// Every attachment's words, one after the other, as little-endian bytes.
std::vector<std::uint8_t> littleEndianBytes(const Framebuffer& target)
{
    std::vector<std::uint8_t> bytes;
    for (int i = 0; i < static_cast<int>(target.attachments().size()); ++i) {
        for (const std::uint32_t word : target.words(i)) {
            for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<std::uint8_t>(word >> shift));
        }
    }
    return bytes;
}

Expected<void> writeWords(const Stage& stage, const std::string& path)
{
    const Expected<Framebuffer> target = renderForGolden(stage, Format::rgba32f);
    if (!target) return tl::unexpected(target.error());
    return writeFileAtomically(path, littleEndianBytes(*target));
}

Expected<void> compareWords(const Stage& stage, const std::string& path)
{
    const auto hashes = committedHashes();
    if (!hashes) return tl::unexpected(hashes.error());
    const Expected<Framebuffer> target = renderForGolden(stage, Format::rgba32f);
    if (!target) return tl::unexpected(target.error());
    if (hexadecimal(hashOf(*target)) != hashes->at(stage.id)) {
        return fail(stage.id + ": this machine has not the committed hash itself, and cannot say what is right");
    }
    const std::vector<std::uint8_t> here = littleEndianBytes(*target);
    const Expected<std::vector<std::uint8_t>> there = readFile(path);
    if (!there) return tl::unexpected(there.error());
    if (there->size() != here.size()) {
        return fail(path + ": holds " + std::to_string(there->size()) + " bytes and not " +
                    std::to_string(here.size()) + "; write it with `stage_hashes words " + stage.id + " FILE`");
    }
    const auto wordAt = [](const std::vector<std::uint8_t>& bytes, std::size_t word) {
        std::uint32_t value = 0;
        for (std::size_t k = 4; k-- > 0;) value = value << 8 | bytes[4 * word + k];
        return value;
    };
    std::size_t begin = 0;  // of the attachment
    for (int i = 0; i < static_cast<int>(target->attachments().size()); ++i) {
        const std::size_t count = target->words(i).size();
        for (std::size_t k = 0; k < count; ++k) {
            const std::uint32_t a = wordAt(here, begin + k), b = wordAt(*there, begin + k);
            if (a == b) continue;
            const bool isDepth = i == target->depthIndex();
            const std::size_t channels = isDepth ? 1 : 4, pixel = k / channels;
            float right, wrong;
            std::memcpy(&right, &a, 4);
            std::memcpy(&wrong, &b, 4);
            std::printf("%zu,%zu\n", pixel % kGoldenWidth, pixel / kGoldenWidth);
            std::printf("stage %s, pixel %zu,%zu, %s: %.9g (%08x), should be %.9g (%08x)\n", stage.id.c_str(),
                        pixel % kGoldenWidth, pixel / kGoldenWidth,
                        isDepth ? "depth" : std::string(1, "rgba"[k % 4]).c_str(), static_cast<double>(wrong), b,
                        static_cast<double>(right), a);
            return {};
        }
        begin += count;
    }
    return fail(stage.id + ": no word differs from " + path);
}

Expected<void> writeTrace(const Stage& stage, const std::string& pixel, const std::string& path)
{
    int x = -1, y = -1;
    const char* const end = pixel.data() + pixel.size();
    const auto comma = std::from_chars(pixel.data(), end, x);
    if (comma.ec == std::errc() && comma.ptr != end) std::from_chars(comma.ptr + 1, end, y);
    const Expected<PreparedStage> prepared = PreparedStage::prepare(stage);
    if (!prepared) return tl::unexpected(prepared.error());
    Expected<Framebuffer> target = Framebuffer::create(kGoldenWidth, kGoldenHeight, Format::rgba32f);
    if (!target) return tl::unexpected(target.error());
    Frame frame(*target, {1, 64});
    prepared->record(frame, kGoldenWidth, kGoldenHeight);
    const Expected<relief::trace::PixelTrace> trace = relief::trace::tracePixel(frame, x, y);
    if (!trace) return fail("pixel " + pixel + ": " + trace.error().message);
    const samples::trace::Subject subject({&stage, &stage, "", "", {}}, "");
    const std::string text = toText(tell(*trace, subject), true);
    return writeFileAtomically(path, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

Expected<void> timeStage(const Stage& stage)
{
    using Clock = std::chrono::steady_clock;
    const Expected<PreparedStage> prepared = PreparedStage::prepare(stage);
    if (!prepared) return tl::unexpected(prepared.error());
    Expected<Framebuffer> target = Framebuffer::create(640, 360);
    if (!target) return tl::unexpected(target.error());
    double least = 1e9;
    for (int i = 0; i < 20; ++i) {
        const Clock::time_point begin = Clock::now();
        Frame frame(*target, {1, 64});
        prepared->record(frame, 640, 360);
        frame.run();
        least = std::min(least, std::chrono::duration<double, std::milli>(Clock::now() - begin).count());
    }
    std::printf("%s: %.1f ms a frame of 640x360, %d lanes, one thread\n", stage.id.c_str(), least, kLanes);
    return {};
}

Expected<void> checkNames(const std::string& folder)
{
    for (const char* name : {"äα.pfm", "окно 窓.pfm", "𝄞.pfm"}) {
        const std::string path = folder + "/" + name;
        for (const std::uint8_t byte : {std::uint8_t{1}, std::uint8_t{2}}) {  // the second time it replaces a file
            const std::vector<std::uint8_t> bytes(1000, byte);
            if (const auto written = writeFileAtomically(path, bytes); !written) return written;
            const auto read = readFile(path);
            if (!read) return tl::unexpected(read.error());
            if (*read != bytes) return fail(path + ": read back other bytes than were written");
        }
        std::error_code ignored;
        std::filesystem::remove(pathOf(path), ignored);
    }
    std::printf("files of any name are written, read and replaced\n");
    return {};
}

Expected<void> run(const Arguments& words)
{
    const std::string what = words.empty() ? "" : words[0];
    if (what == "names" && words.size() == 2) return checkNames(words[1]);
    const bool ofStage = (what == "words" || what == "compare") ? words.size() == 3
                         : what == "trace"                      ? words.size() == 4
                         : what == "time"                       ? words.size() == 2
                                                                : false;
    if (!ofStage) return assertHashes(words);
    const Expected<const Stage*> stage = findStage(words[1]);
    if (!stage) return tl::unexpected(stage.error());
    if (what == "words") return writeWords(**stage, words[2]);
    if (what == "compare") return compareWords(**stage, words[2]);
    if (what == "trace") return writeTrace(**stage, words[2], words[3]);
    return timeStage(**stage);
}

}  // namespace

int main(int argc, char** argv)
{
    const Expected<void> result = run({argv + 1, argv + argc});
    if (result) return 0;
    std::fprintf(stderr, "%s\n", result.error().message.c_str());
    return 1;
}
