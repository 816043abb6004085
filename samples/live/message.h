// What the window's process and those that run a learner's code say to each other: values one after the other, as they
// lie in memory. Both are the same program.
#pragma once

#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

namespace relief::samples::live {

class Message
{
public:
    enum class Kind : char
    {
        // to the process that makes others
        make,     // of an object; with a socket and a picture's memory
        preload,  // what stages read

        // to one that draws
        draw,

        // from it
        loaded,   // Description
        begins,   // inputs are there, drawing begins
        drawn,    // Drawn
        refused,  // a line that says why
        crashed   // Crash
    };

    explicit Message(Kind kind) : mKind(kind) { put(kind); }
    explicit Message(std::string received) : bytes(std::move(received)) { get(mKind); }

    Kind kind() const { return mKind; }

    template <class T>
    Message& put(const T& value)
    {
        static_assert(std::is_trivially_copyable_v<T>);
        bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
        return *this;
    }
    Message& put(const std::string& text)
    {
        put(text.size());
        bytes += text;
        return *this;
    }
    template <class T>
    Message& put(const std::vector<T>& list)
    {
        put(list.size());
        for (const T& value : list) put(value);
        return *this;
    }

    template <class T>
    Message& get(T& value)
    {
        static_assert(std::is_trivially_copyable_v<T>);
        if (at + sizeof value <= bytes.size()) std::memcpy(&value, bytes.data() + at, sizeof value);
        at += sizeof value;
        return *this;
    }
    Message& get(std::string& text)
    {
        std::size_t size = 0;
        get(size);
        text = at + size <= bytes.size() ? bytes.substr(at, size) : "";
        at += size;
        return *this;
    }
    template <class T>
    Message& get(std::vector<T>& list)
    {
        std::size_t size = 0;
        get(size);
        list.resize(size <= bytes.size() ? size : 0);
        for (T& value : list) get(value);
        return *this;
    }

    std::string bytes;

private:
    std::size_t at = 0;
    Kind mKind = Kind::refused;
};

}  // namespace relief::samples::live
