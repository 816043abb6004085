#include "view/pixels.h"

#include <doctest/doctest.h>

#include "temporary_folder.h"
#include "view/orbit.h"

using namespace relief::samples;

namespace {

Pixels filled(int width, int height, std::uint32_t color)
{
    return {width, height,
            std::vector<std::uint32_t>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), color)};
}

}  // namespace

TEST_CASE("view: two pictures in one, and their difference")
{
    const Pixels left = filled(4, 2, 0xff000000u);
    Pixels right = left;
    right.colors[6] = 0xff000300u;
    const Pixels both = beside(filled(4, 2, 0xff0000ffu), right, 1);
    CHECK(both.at(0, 1) == 0xff0000ffu);
    CHECK(both.at(1, 1) == 0xff000000u);
    CHECK(beside(left, right, 9).colors == left.colors);

    const Difference d = differenceOf(left, right, 8);
    CHECK(d.pixels == 1);
    CHECK(d.largest == 3);
    CHECK(d.x == 2);
    CHECK(d.y == 1);
    CHECK(d.picture.at(2, 1) == 0xff001800u);
    CHECK(d.picture.at(0, 0) == 0xff000000u);
    CHECK(differenceOf(left, right, 255).picture.at(2, 1) == 0xff00ff00u);
    CHECK(differenceOf(left, left, 8).pixels == 0);
    right.colors[6] = 0xfe000000u;  // alpha counts, too
    CHECK(differenceOf(left, right, 8).largest == 1);
}

TEST_CASE("view: a pixel as it is stored and as linear light")
{
    CHECK(storedText(0xff0000bcu) == "188 0 0 255");
    CHECK(decodedText(0xff0000bcu) == "0.5029 0.0000 0.0000 1.0000");
}

TEST_CASE("view: a smaller picture is the mean of the larger one, and a file gives back what was written")
{
    Pixels picture = filled(6, 4, 0xff000000u);
    picture.colors[0] = 0xff000064u;
    const Pixels small = shrunk(picture, 3, 2);
    CHECK(small.width == 3);
    CHECK(small.at(0, 0) == 0xff000019u);
    CHECK(small.at(1, 1) == 0xff000000u);
    CHECK(shrunk(small, 7, 5).colors.size() == 35);

    const TemporaryFolder folder;
    REQUIRE(writePixels((folder / "p.png").string(), picture));
    CHECK(readPixels((folder / "p.png").string())->colors == picture.colors);
    CHECK_FALSE(readPixels((folder / "none.png").string()));
    CHECK_FALSE(writePixels((folder / "no/p.png").string(), picture));
    CHECK(folder.fileCount() == 1);
}

TEST_CASE("view: a camera that is moved by hand keeps its distance, its target or its direction")
{
    const Camera camera{.position = {0.0f, 0.9f, -0.75f}};
    const auto distance = [](const Camera& c) {
        const glm::vec3 d = c.position - c.target;
        return std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
    };
    const Camera turned = orbited(camera, 90.0f, 10.0f);
    CHECK(distance(turned) == doctest::Approx(distance(camera)));
    CHECK(turned.target == camera.target);
    CHECK(orbited(camera, 0.0f, 400.0f).position.z != 0.0f);  // never straight above
    CHECK(distance(zoomed(camera, 0.5f)) == doctest::Approx(0.5f * distance(camera)));
    CHECK(distance(zoomed(camera, 1e6f)) == doctest::Approx(50.0f));
    const Camera aside = moved(camera, 0.1f, 0.0f);
    CHECK(aside.target.x > 0.05f);
    CHECK(distance(aside) == doctest::Approx(distance(camera)));
}
