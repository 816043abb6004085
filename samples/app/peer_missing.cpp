// In place of tests/benchmarks/peer.cpp where EGL was not found, and in builds with sanitizers.
#include "commands.h"

namespace relief::samples {

Expected<void> benchPeer(const PeerOptions&)
{
    return fail(
        "bench --peer: this build has no Mesa to compare with; install libegl-dev, libgl-dev and libgl1-mesa-dri, "
        "configure and build again, without sanitizers");
}

}  // namespace relief::samples
