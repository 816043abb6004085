// What is said of pictures that are made by hand, in front of a catalogue of three mistakes.
#include "grader/diagnosis.h"

#include <doctest/doctest.h>

#include "relief/check/hash.h"

namespace {

using namespace relief;
using namespace relief::samples::grader;
using Kind = Diagnosis::Kind;

// A picture of one grey, with a spot of another on every tenth pixel of a row.
Framebuffer grey(float light, float spot = -1.0f)
{
    Framebuffer picture = *Framebuffer::create(kWidth, kHeight, Format::rgba32f, Store::keep);
    for (glm::vec4& color : picture.color32f()) color = glm::vec4(light, light, light, 1.0f);
    for (int x = kStep / 2; spot >= 0.0f && x < kWidth; x += kStep) {
        picture.color32f()[static_cast<std::size_t>(kStep / 2 * kWidth + x)] = glm::vec4(spot, spot, spot, 1.0f);
    }
    return picture;
}

struct Setup
{
    Exercise exercise;
    Catalogue catalogue;

    Setup()
    {
        exercise.mistakes = {{"dark", "It is too dark", "See 0.01.", {}}, {"bright", "Why is it so bright?", "", {}}};
        add("answer", grey(0.5f));
        add("start", grey(0.0f));
        add("dark", grey(0.2f));
        add("bright", grey(0.9f));
        add("dark+bright", grey(0.3f));
        catalogue.goal = codesOf(grey(0.5f));
    }
    void add(const std::string& name, const Framebuffer& picture)
    {
        catalogue.entries.push_back({name, hexadecimal(hashOf(picture)), smallOf(codesOf(picture))});
    }
    Diagnosis of(const Framebuffer& picture) const { return diagnose(exercise, catalogue, picture); }
};

}  // namespace

TEST_CASE("diagnosis: the same bits are solved, as given, a mistake, or two")
{
    const Setup setup;
    CHECK(setup.of(grey(0.5f)).kind == Kind::solved);
    CHECK(setup.of(grey(0.0f)).kind == Kind::start);
    const Diagnosis dark = setup.of(grey(0.2f)), bright = setup.of(grey(0.9f)), both = setup.of(grey(0.3f));
    CHECK(dark.kind == Kind::exact);
    CHECK(dark.sentence == "It is too dark: your picture is, bit for bit, what that gives. See 0.01.");
    CHECK(bright.sentence == "Why is it so bright? Your picture is, bit for bit, what that gives.");
    CHECK(both.entry == "dark+bright");
    CHECK(both.sentence ==
          "Two things: It is too dark. Why is it so bright? Your picture is, bit for bit, what that gives. See 0.01.");
    CHECK(!dark.isSolved());
}

TEST_CASE("diagnosis: two codes at most are solved, and the largest is named with its place")
{
    const Setup setup;
    const Diagnosis one = setup.of(grey(0.5f, srgbToLinear(189)));  // 0.5 has the code 188
    CHECK(one.kind == Kind::nearly);
    CHECK(one.isSolved());
    CHECK(one.fromGoal.largest == 1);
    CHECK(one.fromGoal.differing == kSmallWidth);
    CHECK(one.sentence.starts_with("Solved, to 1 code of 255: 48 pixels differ from the goal, by the most at (5, 5)."));
    CHECK(setup.of(grey(0.5f, 0.50001f)).sentence.starts_with("Solved: every code of every pixel is the goal's."));
    CHECK(setup.of(grey(0.5f, srgbToLinear(190))).kind == Kind::nearly);
    CHECK(!setup.of(grey(0.5f, srgbToLinear(191))).isSolved());
}

TEST_CASE("diagnosis: a mistake is named where it is near and the next one far, and nothing is where two are as near")
{
    const Setup setup;
    const Diagnosis near = setup.of(grey(0.2f, 0.25f));
    CHECK(near.kind == Kind::near);
    CHECK(near.entry == "dark");
    CHECK(near.nearest < kNear);
    const Diagnosis between = setup.of(grey(0.25f));
    CHECK(between.kind == Kind::unknown);
    CHECK(between.sentence.find("none of the 3 known mistakes") != std::string::npos);
    const Diagnosis spot = setup.of(grey(0.5f, 1.0f));  // near the goal is no mistake
    CHECK(spot.kind == Kind::unknown);
    CHECK(spot.sentence.find("nearer than any known mistake") != std::string::npos);

    // Two entries whose small pictures are the same.
    Setup tied;
    Framebuffer other = grey(0.2f);
    other.color32f()[0] = glm::vec4(1.0f);
    tied.add("bright", other);
    Framebuffer third = grey(0.2f);
    third.color32f()[1] = glm::vec4(1.0f);
    CHECK(tied.of(third).kind == Kind::unknown);
}

TEST_CASE("diagnosis: an open exercise holds the picture to its conditions, and says what it measured")
{
    Setup setup;
    setup.exercise.kind = "open";
    setup.catalogue.entries[1].small = smallOf(codesOf(grey(0.9f)));
    setup.exercise.conditions = {{"mean", "<=", 0.9, true, "It is darker"},
                                 {"brightest", ">=", 0.5, false, "It shines"}};
    CHECK(setup.of(grey(0.4f)).kind == Kind::open);
    CHECK(setup.of(grey(0.5f)).isSolved());
    const Diagnosis black = setup.of(grey(0.01f));
    CHECK(black.kind == Kind::conditions);
    CHECK(black.sentence == "Not yet: It shines: brightest is 0.098, and should be at least 0.500.");
    CHECK(setup.of(grey(0.95f)).sentence.find("It is darker: mean is") != std::string::npos);
}
