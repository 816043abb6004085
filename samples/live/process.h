// What runs in the other processes (renderer.h). Neither function returns.
#pragma once

#include <span>

#include "live/message.h"
#include "live/renderer.h"

namespace relief::samples::live {

// Sent by a signal's handler, so it has a fixed size.
struct Crash
{
    Message::Kind kind = Message::Kind::crashed;
    int signal = 0;
    int count = 0;
    std::uintptr_t counters[48] = {};  // where it was, and the callers
};

[[noreturn]] void runMaker(int socket);

void put(Message& message, const InputFiles& files);
void get(Message& message, InputFiles& files);
void put(Message& message, const Inputs& inputs);
void get(Message& message, Inputs& inputs);
void put(Message& message, const Look& look);
void get(Message& message, Look& look);
void put(Message& message, const std::vector<ViewName>& views);
void get(Message& message, std::vector<ViewName>& views);
void put(Message& message, const Description& description);
void get(Message& message, Description& description);

// A message of a socket that keeps their limits, with up to two descriptors. False where the other end is gone.
bool send(int socket, const Message& message, std::span<const int> descriptors = {});

enum class Received
{
    message,
    nothing,  // yet
    end
};
Received receive(int socket, std::string& bytes, bool wait, int* descriptors = nullptr);

}  // namespace relief::samples::live
