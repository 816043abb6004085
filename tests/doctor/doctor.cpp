// The doctor: every fault named on every map, nothing on sound ones; what it cures is sound again.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <doctest/doctest.h>

#include "live_command.h"
#include "maps.h"
#include "relief/mesh/primitives.h"
#include "relief/mesh/tangents.h"
#include "temporary_folder.h"

namespace {

using namespace doctor_trials;

std::string wordsOf(const Diagnosis& d)
{
    std::string words = nameOf(d.kind);
    for (const Finding& f : d.findings) words += std::string(", ") + nameOf(f.fault) + " (" + f.evidence + ")";
    return words;
}

const std::vector<SoundMap>& maps()
{
    static const std::vector<SoundMap> all = soundMaps(RELIEF_ASSET_FOLDER);
    return all;
}

// All maps and pairs of faults take half a minute: the test long.doctor.
bool takesAll()
{
    return std::getenv("RELIEF_FULL_TRIALS") != nullptr;
}

// On which faults are made: bricks and domes where time is short.
std::vector<const SoundMap*> trials()
{
    if (!takesAll()) return {&maps()[1], &maps()[6]};
    std::vector<const SoundMap*> chosen;
    for (const SoundMap& map : maps()) chosen.push_back(&map);
    return chosen;
}

}  // namespace

TEST_CASE("doctor: a sound map has no fault, and heights that give it")
{
    for (const SoundMap& map : maps()) {
        CAPTURE(map.name);
        const Diagnosis d = *diagnose(channelsOf(codesOf(map)));
        CHECK_MESSAGE(d.findings.empty(), wordsOf(d));
        CHECK(d.kind == Kind::tangentSpace);
        const Diagnosis with = *diagnose(channelsOf(codesOf(map)), {.heights = map.heights});
        CHECK_MESSAGE(with.findings.empty(), wordsOf(with));
        CHECK(d.heights.residual < 0.02);
        CHECK(d.heights.range == doctest::Approx(static_cast<double>(map.scale)).epsilon(0.12));
    }
}

TEST_CASE("doctor: 95 of 100 single faults are named, and nine of ten in pairs")
{
    const auto examine = [](const std::vector<MadeFault>& made, double least) {
        int named = 0, asked = 0, others = 0;
        for (const SoundMap* const one : trials()) {
            const SoundMap& map = *one;
            for (const MadeFault& fault : made) {
                Given given;
                if (fault.givesHeights) given.heights = map.heights;
                const Diagnosis d = *diagnose(channelsOf(fault.make(map)), given);
                const Verdict verdict = verdictOf(d, fault.faults);
                named += verdict.named;
                others += verdict.others;
                asked += static_cast<int>(fault.faults.size());
                if (verdict.named < static_cast<int>(fault.faults.size()) || verdict.others > 0)
                    MESSAGE(map.name, ", ", std::string(fault.name), ": ", wordsOf(d));
            }
        }
        MESSAGE(named, " of ", asked, " are named, and ", others, " that are none");
        CHECK(named >= least * asked);
        CHECK(others <= 0.05 * asked);
    };
    examine(singleFaults(), 0.95);
    if (takesAll()) examine(doubleFaults(), 0.9);
}

TEST_CASE("doctor: what it cures is the map as it was, but for rounding")
{
    for (const SoundMap* const one : trials()) {
        const SoundMap& map = *one;
        const Image8 right = codesOf(map);
        for (const MadeFault& fault : singleFaults()) {
            // Of what was decoded, dark codes are lost; of others the strength is, or the texels.
            int allowed = 0;
            switch (fault.faults[0]) {
                case Fault::greenMirrored:
                case Fault::redMirrored:
                case Fault::bothMirrored:
                case Fault::belowSurface:
                    allowed = 1;
                    break;
                case Fault::wasEncoded:
                case Fault::alphaGreen:
                    allowed = 6;
                    break;
                default:
                    continue;
            }
            CAPTURE(map.name);
            CAPTURE(fault.name);
            Given given;
            if (fault.givesHeights) given.heights = map.heights;
            const Image8 cured = pictureOf(diagnose(channelsOf(fault.make(map)), given)->cured);
            REQUIRE(cured.pixels.size() == right.pixels.size());
            int most = 0;
            double sum = 0.0;
            for (std::size_t i = 0; i < cured.pixels.size(); ++i) {
                const int difference = std::abs(int{cured.pixels[i]} - int{right.pixels[i]});
                most = std::max(most, difference);
                sum += difference;
            }
            CHECK(sum / static_cast<double>(cured.pixels.size()) < 0.6);
            // z of what leans far away is very uncertain where it was not stored.
            if (fault.faults[0] != Fault::alphaGreen) CHECK(most <= allowed);
        }
    }
}

TEST_CASE("doctor: heights and pictures of colours are known for what they are")
{
    const std::string assets = RELIEF_ASSET_FOLDER;
    CHECK(diagnose(channelsOf(*readImage(assets + "/marble-heights.png")))->kind == Kind::heights);
    for (const char* colors : {"marble-albedo", "bricks-albedo", "inlay-albedo", "inlay-emission"}) {
        CAPTURE(colors);
        CHECK(diagnose(channelsOf(*readImage(assets + "/" + colors + ".png")))->kind == Kind::noMap);
    }
    // A sphere's normals in its own space.
    NormalField field{64, 32, {}};
    for (int i = 0; i < 64 * 32; ++i) {
        const double longitude = (i % 64 + 0.5) / 64 * 6.283185307, latitude = ((i / 64 + 0.5) / 32 - 0.5) * 3.14159265;
        field.normals.push_back({static_cast<float>(std::cos(latitude) * std::cos(longitude)),
                                 static_cast<float>(std::sin(latitude)),
                                 static_cast<float>(std::cos(latitude) * std::sin(longitude))});
    }
    CHECK(diagnose(channelsOf(pictureOf(field)))->kind == Kind::objectSpace);
    CHECK_FALSE(diagnose(channelsOf(Image8{4, 4, std::vector<std::uint8_t>(64, 128)})));
}

TEST_CASE(
    "doctor: floats whose alpha is 1 and whose red is even are no DXT5nm; waves of a block's length are no blocks")
{
    for (const int waves : {2, 3, 4, 8, 16}) {
        CAPTURE(waves);
        ImageFloat ridges{64, 64, {}};
        for (int i = 0; i < 64 * 64; ++i) {
            const float y = 0.4f * std::sin(static_cast<float>(i / 64 * waves) * (6.2831853f / 64.0f));
            for (const float c : {0.0f, y, std::sqrt(1.0f - y * y)}) ridges.pixels.push_back(c * 0.5f + 0.5f);
            ridges.pixels.push_back(1.0f);
        }
        const Diagnosis d = *diagnose(channelsOf(ridges));
        CHECK(d.kind == Kind::tangentSpace);
        CHECK_MESSAGE(d.findings.empty(), wordsOf(d));
    }
}

TEST_CASE("doctor: what no triangle uses is left out of account")
{
    const SoundMap& map = maps()[6];
    Image8 atlas = codesOf(map), faulty = singleFaults()[0].make(map);
    for (Image8* picture : {&atlas, &faulty}) {
        for (std::size_t i = 0; i < picture->pixels.size(); i += 4) {
            const std::size_t x = i / 4 % 256, y = i / 4 / 256;
            if (x > 200 || y > 150) std::fill_n(&picture->pixels[i], 4, std::uint8_t{255});
        }
    }
    const Diagnosis d = *diagnose(channelsOf(atlas));
    CHECK(d.kind == Kind::tangentSpace);
    CHECK_MESSAGE(d.findings.empty(), wordsOf(d));
    CHECK(diagnose(channelsOf(faulty))->has(Fault::greenMirrored));
}

TEST_CASE("doctor: a mesh whose tangents contradict its uv")
{
    const SoundMap& map = maps()[2];
    Mesh mesh = *withTangents(makeCube());
    const Channels picture = channelsOf(codesOf(map));
    CHECK(diagnose(picture, {.meshes = {mesh}})->findings.empty());
    mesh.tangents[0].w = -mesh.tangents[0].w;
    const Diagnosis d = *diagnose(picture, {.meshes = {mesh}});
    CHECK(d.has(Fault::meshMirrored));
    CHECK(d.findings.size() == 1);
}

TEST_CASE("doctor: the command prints, cures, and refuses in one line")
{
    const TemporaryFolder folder;
    const MadeFault& green = singleFaults()[0];
    const Image8 upsideDown = green.make(maps()[2]);
    const std::string wrong = (folder / "wrong.png").string(), cured = (folder / "cured.png").string();
    REQUIRE(writePng(wrong, upsideDown.width, upsideDown.height, upsideDown.pixels));
    const auto run = [&](const std::string& words) { return runCommand(folder, "doctor " + words, "relief_doctor"); };
    const Outcome first = run("wrong.png --fix cured.png --evidence evidence.png --write-heights heights.png");
    CHECK(first.code == 1);
    CHECK(first.out.find("fault: green is upside down") != std::string::npos);
    CHECK(first.out.find("remedy: ./relief doctor wrong.png --fix cured.png") != std::string::npos);
    const std::vector<std::uint8_t> is = std::get<Image8>(*readImage(cured)).pixels, right = codesOf(maps()[2]).pixels;
    REQUIRE(is.size() == right.size());
    CHECK(std::equal(is.begin(), is.end(), right.begin(), [](int a, int b) { return std::abs(a - b) <= 1; }));
    CHECK(std::get<Image8>(*readImage((folder / "evidence.png").string())).width == 4 * upsideDown.width);
    CHECK(readImage((folder / "heights.png").string()));
    const Outcome second = run("cured.png");
    CHECK(second.code == 0);
    CHECK(second.out.find("no fault was found") != std::string::npos);
    CHECK(run("wrong.png --json").out.find("\"fault\": \"greenMirrored\"") != std::string::npos);
    for (const char* words : {"missing.png", "wrong.png --height missing.png", "wrong.png --mesh missing.obj", ""}) {
        const Outcome refused = run(words);
        CHECK(refused.code == 2);
        CHECK(refused.out.empty());
        CHECK(std::count(refused.err.begin(), refused.err.end(), '\n') == 1);
    }
}
