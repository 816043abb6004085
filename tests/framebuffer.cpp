// The render target: sizes, formats, and what it holds before anything is drawn.
#include "relief/pipeline/framebuffer.h"

#include <string>
#include <utility>

#include "pipeline_fixture.h"
#include "relief/pipeline/format.h"

using namespace fixture;

TEST_CASE("framebuffer: each format has its own storage, of the right size")
{
    for (const Format format : {Format::rgba8, Format::rgba8Srgb, Format::rgba16f, Format::r32f, Format::rgba32f}) {
        for (const Store depth : {Store::discard, Store::keep}) {
            const Framebuffer target = makeTarget(7, 5, format, depth);
            CHECK(target.width() == 7);
            CHECK(target.height() == 5);
            CHECK(target.attachments()[0].format == format);
            CHECK(target.attachments()[1].store == depth);
            CHECK(target.color32f().size() == (format == Format::rgba32f ? 35 : 0));
            CHECK(target.color16f().size() == (format == Format::rgba16f ? 35 : 0));
            CHECK(target.colorR32f().size() == (format == Format::r32f ? 35 : 0));
            CHECK(target.color8().size() == (isUnorm(format) ? 35 : 0));
            CHECK(target.words(0).size() == 35u * static_cast<unsigned>(wordsPerPixel(format)));
            CHECK(target.depth().size() == (depth == Store::keep ? 35 : 0));
            for (const glm::vec4& c : target.color32f()) CHECK(c == glm::vec4(0.0f));
            for (const std::uint32_t c : target.color8()) CHECK(c == 0);
            for (const float z : target.depth()) CHECK(z == 1.0f);
        }
    }
}

TEST_CASE("framebuffer: an attachment that is not there has no words")
{
    Framebuffer target = makeTarget(4, 4, Format::rgba8);
    CHECK(target.words(target.stencilIndex()).empty());
    CHECK(target.words(2).empty());
    CHECK(std::as_const(target).words(-1).empty());
}

TEST_CASE("framebuffer: impossible sizes are errors that name the size and the limit (S-113)")
{
    const int sizes[][2] = {{0, 0},           {0, 4},     {4, 0},     {-1, 4},
                            {4, -2147483647}, {16385, 1}, {1, 16385}, {2147483647, 2147483647}};
    for (const auto& size : sizes) {
        const Expected<Framebuffer> target = Framebuffer::create(size[0], size[1]);
        REQUIRE_FALSE(target.has_value());
        CHECK(target.error().message.find(std::to_string(size[0]) + "x" + std::to_string(size[1])) !=
              std::string::npos);
        CHECK(target.error().message.find("16384") != std::string::npos);
    }
    CHECK(Framebuffer::create(16384, 1).has_value());
    CHECK(Framebuffer::create(1, 16384).has_value());
    CHECK(Framebuffer::create(1, 1).has_value());
}
