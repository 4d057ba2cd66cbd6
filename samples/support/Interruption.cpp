// SPDX-License-Identifier: MIT
#include "Interruption.h"

#include <csignal>

namespace
{

volatile std::sig_atomic_t received = 0;

void receive(int signal)
{
    received = 1;
    std::signal(signal, SIG_DFL);
}

void setHandlers(void (*handler)(int))
{
    for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, handler);
}

}  // namespace

Interruption::Interruption()
{
    received = 0;
    setHandlers(receive);
}

Interruption::~Interruption()
{
    setHandlers(SIG_DFL);
}

bool Interruption::requested()
{
    return received != 0;
}
