// Transposed loads and stores: between words that follow each other in memory, and the same word of every lane. A
// gather of the processor takes longer. Goes by quads: four addresses, four registers of 16 bytes, and two rounds of
// shuffles.
#pragma once

#include "relief/lanes/native.h"

namespace relief::inline RELIEF_WIDTH::native {

// a, b, c and d hold a lane's four words in every quad: out[k] has the k-th word of every lane. Its own inverse.
inline void transposeQuads(IntVector a, IntVector b, IntVector c, IntVector d, IntVector out[4])
{
    // The second round on floats: g++ 12 takes two instructions for it on integers.
    const FloatVector t0 = (FloatVector)shuffleQuads<0, 4, 1, 5>(a, b),
                      t1 = (FloatVector)shuffleQuads<0, 4, 1, 5>(c, d);
    const FloatVector t2 = (FloatVector)shuffleQuads<2, 6, 3, 7>(a, b),
                      t3 = (FloatVector)shuffleQuads<2, 6, 3, 7>(c, d);
    out[0] = (IntVector)shuffleQuads<0, 1, 4, 5>(t0, t1);
    out[1] = (IntVector)shuffleQuads<2, 3, 6, 7>(t0, t1);
    out[2] = (IntVector)shuffleQuads<0, 1, 4, 5>(t2, t3);
    out[3] = (IntVector)shuffleQuads<2, 3, 6, 7>(t2, t3);
}

// The inverse of loadTransposed: the k-th 32-bit word at address(i) = in[k] lane i; 16 bytes are written per lane.
template <class Address>
[[gnu::always_inline]] inline void storeTransposed(const IntVector in[4], const Address& address)
{
    IntVector lane[4];  // lane[k] holds the words of lane k in every quad
    transposeQuads(in[0], in[1], in[2], in[3], lane);
    storeQuads(lane[0], address);  // no loop: g++ 12 at -O2 would keep it, and the lanes in memory
    storeQuads(lane[1], [&](int i) { return address(i + 1); });
    storeQuads(lane[2], [&](int i) { return address(i + 2); });
    storeQuads(lane[3], [&](int i) { return address(i + 3); });
}

// Gathers 16 bytes per lane, quad after quad, and gives word k of every lane.
class FourWords
{
public:
    template <int quad>
    void add(const std::byte* a, const std::byte* b, const std::byte* c, const std::byte* d)
    {
        r0 = insertQuad<quad>(r0, loadQuad(a));
        r1 = insertQuad<quad>(r1, loadQuad(b));
        r2 = insertQuad<quad>(r2, loadQuad(c));
        r3 = insertQuad<quad>(r3, loadQuad(d));
    }
    void transposed(IntVector out[4]) const { transposeQuads(r0, r1, r2, r3, out); }

private:
    IntVector r0 = {}, r1 = {}, r2 = {}, r3 = {};
};

// The same for 8 bytes per lane.
class TwoWords
{
public:
    template <int quad>
    void add(const std::byte* a, const std::byte* b, const std::byte* c, const std::byte* d)
    {
        r0 = insertQuad<quad>(r0, loadTwoHalves(a, b));
        r1 = insertQuad<quad>(r1, loadTwoHalves(c, d));
    }
    void transposed(IntVector out[2]) const
    {
        out[0] = (IntVector)shuffleQuads<0, 2, 4, 6>((FloatVector)r0, (FloatVector)r1);
        out[1] = (IntVector)shuffleQuads<1, 3, 5, 7>((FloatVector)r0, (FloatVector)r1);
    }

private:
    IntVector r0 = {}, r1 = {};
};

// Calls visit.operator()<quad>() for every quad of a block.
template <class Visit>
[[gnu::always_inline]] inline void forEachQuad(const Visit& visit)
{
    visit.template operator()<0>();
    if constexpr (kLanes > 4) visit.template operator()<1>();
    if constexpr (kLanes > 8) {
        visit.template operator()<2>();
        visit.template operator()<3>();
    }
}

// out[k] lane i = the k-th 32-bit word at address(i). Words is FourWords or TwoWords: 16 or 8 bytes are read per lane.
template <class Words, class Address>
[[gnu::always_inline]] inline void loadTransposed(const Address& address, IntVector* out)
{
    Words words;
    forEachQuad([&]<int quad>() __attribute__((always_inline)) {
        words.template add<quad>(address(4 * quad), address(4 * quad + 1), address(4 * quad + 2),
                                 address(4 * quad + 3));
    });
    words.transposed(out);
}

// From two addresses per lane, lane by lane: what both are made of, such as an index, is then read only once.
template <class Words, class Address, class OtherAddress>
[[gnu::always_inline]] inline void loadTransposed(const Address& address, const OtherAddress& other, IntVector* out,
                                                  IntVector* otherOut)
{
    Words words, otherWords;
    forEachQuad([&]<int quad>() __attribute__((always_inline)) {
        constexpr int a = 4 * quad, b = a + 1, c = a + 2, d = a + 3;
        words.template add<quad>(address(a), address(b), address(c), address(d));
        otherWords.template add<quad>(other(a), other(b), other(c), other(d));
    });
    words.transposed(out);
    otherWords.transposed(otherOut);
}

}  // namespace relief::inline RELIEF_WIDTH::native
