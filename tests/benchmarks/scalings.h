// How cost grows: with pixels, triangles, threads, lights and the side of a texture. Which frames to draw, and what one
// of them took, in a process of its own.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "prepare.h"

namespace relief::benchmarks {

struct Recorded
{
    std::shared_ptr<const void> kept;  // must live until the frame has run
    const Texture* texture = nullptr;  // whose mip levels are of interest
};

// A frame of one size.
struct Point
{
    std::string scaling;  // pixels, triangles, threads, lights or texture
    std::string curve;    // what the points that belong together have in common
    double x;             // how many pixels, triangles, threads and lights, or texels of a side
    samples::Size size;
    int threads;
    std::function<Expected<Recorded>(Frame&, samples::Size)> record;
};

// All points; of those whose x is more than `part` of the largest of their scaling, only the two smallest of a curve.
// Threads are what they are. All but `pixels` are drawn at `size`, and all but `threads` with all threads.
std::vector<Point> scalingPoints(samples::Size size, double part);

// What drawing a point took.
struct Drawn
{
    double firstSeconds = 0.0;    // of the first frame, which allocates memory and builds mip levels
    std::vector<double> seconds;  // of those after it
    double peakMebibytes = 0.0;   // resident memory of a process that does nothing else
    std::uint64_t draws = 0, pixelsShaded = 0;
    int levelsBuilt = 0;  // of the texture
};

// Draws the first frame and nine more, or fewer once these have taken a second.
Expected<Drawn> drawPoint(const Point& point);

}  // namespace relief::benchmarks
