// apps/messages.h
//
// Prints messages to the user on standard error.

#pragma once

#include <string>

namespace penumbra {

// Prints the message as one line on standard error. Because names from files may contain any bytes, control
// characters and invalid UTF-8 are escaped, and the middle of a very long line is omitted. If printing a
// message fails, the program continues, and MessageFailed() returns true.
void Say(const std::string& message);

// Prints the text on standard error unchanged, without escaping or shortening.
void PrintText(const std::string& text);

// The line that Say() prints for `message`, without the line end.
std::string OneLine(const std::string& message);

// True if an attempt to print a message has failed since the program started.
bool MessageFailed();

}  // namespace penumbra
