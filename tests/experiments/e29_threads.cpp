// E-29: one thread and several.
#include <thread>

#include "experiments.h"
#include "triangle_scene.h"

namespace relief::experiments {

namespace {

constexpr int kThreadCounts[] = {1, 2, 3, 4, 8};

// By how much any of a pixel's channels differs from that of one thread.
Error differenceTo(const Framebuffer& one, const Framebuffer& other)
{
    ErrorSum sum;
    for (std::size_t i = 0; i < one.color32f().size(); ++i) {
        const glm::vec4 a = one.color32f()[i], b = other.color32f()[i];
        double largest = std::abs(static_cast<double>(one.depth()[i]) - static_cast<double>(other.depth()[i]));
        for (int c = 0; c < 4; ++c)
            largest = std::fmax(largest, std::abs(static_cast<double>(a[c]) - static_cast<double>(b[c])));
        sum.add(largest);
    }
    return sum.result();
}

}  // namespace

Experiment threads(Effort)
{
    Experiment e;
    e.id = "E-29";
    e.title = "Threads";
    e.question =
        "Each tile is drawn by one thread from beginning to end, in the order of the draws, so the picture does not "
        "depend on how many there are: the error, a difference to one thread's picture, has to be 0. How much faster "
        "does each further thread make a frame whose triangles are spread evenly, and one that has all of them in a "
        "corner?";
    e.item = "pixel";
    e.unit = "difference of a channel";
    e.rivals = Rivals::ofOneParameter;
    for (const bool corner : {false, true}) {
        const std::string where = corner ? "in a corner" : "even";
        const auto triangles = std::make_shared<const TriangleScene>(2500, 32, corner ? 0.15 : 1.0);
        for (const int count : kThreadCounts) {
            const FrameOptions options = {.threads = count};
            const auto f = framed(*triangles, options, false), one = framed(*triangles, {.threads = 1}, false);
            const Statistics s = f->frame.run();
            const auto hash = [=] {
                f->frame.run();
                return hashOf(f->target);
            };
            const auto outcome = [=] {
                one->frame.run();
                f->frame.run();
                Outcome result(differenceTo(one->target, f->target),
                               {{"threads used", static_cast<double>(count)},
                                {"tiles touched", static_cast<double>(s.tilesTouched)}});
                result.imageHash = hash();
                return result;
            };
            const Work work = {[f, triangles] { f->frame.run(); }, static_cast<double>(s.pixelsShaded)};
            Variant v = {std::to_string(count) + (count == 1 ? " thread" : " threads"), where, outcome, work};
            v.threads = count;
            v.isCounted = count == 1;  // threads that wait run instructions, now more, now fewer
            e.variants.push_back(v);
            const auto sameAsOne = [=] {
                one->frame.run();
                return hash() == hashOf(one->target) ? 1.0 : 0.0;
            };
            e.checks.push_back({"every bit as of one thread, " + v.name + ", " + where, 1.0, sameAsOne, 0.0});
        }
    }
    e.finding = [](const Rows& rows) {
        std::string text = "The same bits from any number of threads.";
        for (const char* where : {"even", "in a corner"}) {
            const Row &one = rows("1 thread", where), &two = rows("2 threads", where),
                      &eight = rows("8 threads", where);
            const double faster = one.fastest / two.fastest;
            text += std::string(" Triangles ") + (where[0] == 'e' ? "spread evenly" : where) + ": two threads are " +
                    number(faster, 2) + " times as fast as one (efficiency " + number(50.0 * faster, 0) +
                    " %), eight " + number(one.fastest / eight.fastest, 2) + " times; " +
                    number(one.fact("tiles touched"), 0) + " tiles to share.";
        }
        return text + " This machine has " + std::to_string(std::thread::hardware_concurrency()) +
               " processors; what more threads than that gain is chance.";
    };
    return e;
}

}  // namespace relief::experiments
