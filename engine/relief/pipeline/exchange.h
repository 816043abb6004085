// Something else in the place of all draws' fragment programs, for those who watch a frame run (inspect.cpp,
// trace/pixel_trace.cpp). The draws' own come back at the end.
#pragma once

#include <utility>
#include <vector>

#include "relief/pipeline/frame_storage.h"

namespace relief::inline RELIEF_WIDTH {

// What a draw's own program is, for what stands in its place.
struct OwnProgram
{
    const Programs* programs;
    const void* program;

    void shadeBlocks(std::span<ShadedBlock> blocks, const TriangleBatch& batch, const TriangleCorners* corners) const
    {
        programs->shadeBlocks(program, blocks, batch, corners);
    }
};

// `Watcher` is made of a draw and its OwnProgram; `shadeBlocks` gets it as its program.
template <class Watcher>
class ExchangedPrograms
{
public:
    template <class Make>
    ExchangedPrograms(Frame::Storage& its, const Make& make,
                      void (*shadeBlocks)(const void*, std::span<ShadedBlock>, const TriangleBatch&,
                                          const TriangleCorners*))
        : frame(its), tables(its.draws.size())
    {
        watchers.reserve(tables.size());
        for (std::size_t d = 0; d < tables.size(); ++d) {
            Draw& draw = frame.draws[d];
            tables[d] = *draw.programs;
            tables[d].shadeBlocks = shadeBlocks;
            tables[d].shadeShared = nullptr;
            own.push_back(draw.programs);
            watchers.push_back(make(draw, OwnProgram{draw.programs, draw.fragmentProgram.get()}));
            draw.programs = &tables[d];
            programs.push_back(std::exchange(draw.fragmentProgram, ErasedProgram(&watchers[d], [](const void*) {})));
        }
    }
    ~ExchangedPrograms()
    {
        for (std::size_t d = 0; d < tables.size(); ++d) {
            frame.draws[d].programs = own[d];
            frame.draws[d].fragmentProgram = std::move(programs[d]);
        }
    }
    ExchangedPrograms(const ExchangedPrograms&) = delete;
    ExchangedPrograms& operator=(const ExchangedPrograms&) = delete;

private:
    Frame::Storage& frame;
    std::vector<Programs> tables;
    std::vector<Watcher> watchers;
    std::vector<const Programs*> own;
    std::vector<ErasedProgram> programs;
};

}  // namespace relief::inline RELIEF_WIDTH
