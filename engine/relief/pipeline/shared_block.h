// Quads of several blocks in one. A small triangle leaves most quads of its blocks without a pixel, and a program takes
// as long for one quad as for all.
//
//     three blocks    . a    b c    . .        in one    a b
//                     . .    . .    d .                  c d
//
// A quad moves as a whole, with all that is known of its pixels: what is next to each other stays so. What the program
// gives moves back.
#pragma once

#include <array>

#include "relief/lanes/float.h"

namespace relief::inline RELIEF_WIDTH {

inline constexpr int kQuads = kLanes / 4;  // in a block

// Which blocks of a group share one: `count` places in the group. All live quads of these have room in it, those of the
// first one first. A block by itself stays as it is.
struct SharedBlock
{
    std::array<std::uint8_t, kQuads> parts;
    std::uint8_t count;
};

namespace detail {

// For each set of quads, a bit each: its lanes one after the other, from kLanes on, and each lane's place among them.
struct QuadOrder
{
    alignas(64) std::int32_t lanes[2 * kLanes];
    alignas(64) std::int32_t places[kLanes];
};

inline constexpr std::array<QuadOrder, 1 << kQuads> kQuadOrders = [] {
    std::array<QuadOrder, 1 << kQuads> orders{};
    for (unsigned set = 0; set < orders.size(); ++set) {
        int place = 0;
        for (int lane = 0; lane < kLanes; ++lane) {
            if ((set >> (lane / 4) & 1u) == 0) continue;
            orders[set].lanes[kLanes + place] = lane;
            orders[set].places[lane] = place++;
        }
    }
    return orders;
}();

}  // namespace detail

// The way of a block's quads, given by their lanes, to a shared block where `taken` lanes are others', and back.
class WayOfQuads
{
public:
    WayOfQuads(unsigned quads, int taken) : WayOfQuads(orderOf(quads), countBits(quads), taken) {}

    // The shared block with these quads in it.
    Float there(Float block, Float shared) const { return select(here, permute(block, from), shared); }
    Int there(Int block, Int shared) const { return select(here, permute(block, from), shared); }
    Mask there(Mask block, Mask shared) const
    {
        return there(select(block, Int(1), Int(0)), select(shared, Int(1), Int(0))) != 0;
    }

    // The shared block's lanes that are these quads' now.
    unsigned lanes() const { return here.bits(); }

    // The block; its other quads are anything.
    Float back(Float shared) const { return permute(shared, to); }

private:
    WayOfQuads(const detail::QuadOrder& order, int count, int taken)
        : from(Int::load(order.lanes + (kLanes - taken))),
          to(Int::load(order.places) + taken),
          here(Mask::fromBits(((1u << count) - 1) << taken & kAllLanes))
    {
    }
    static const detail::QuadOrder& orderOf(unsigned quads)
    {
        unsigned set = 0;
        for (int q = 0; q < kQuads; ++q) set |= (quads >> 4 * q & 1u) << q;
        return detail::kQuadOrders[set];
    }

    Int from, to;
    Mask here;
};

}  // namespace relief::inline RELIEF_WIDTH
