// apps/messages.h
//
// Messages to the user on standard error.

#pragma once

#include <string>

namespace penumbra {

// Prints the message as one line. Because names from files may contain any bytes, control characters and
// invalid UTF-8 are escaped, and the middle of a very long line is omitted. If printing fails, the program
// continues; MessageFailed() then returns true.
void Say(const std::string& message);

// Prints the text without escaping or shortening it.
void PrintText(const std::string& text);

// The line that Say() prints for `message`, without the line end.
std::string OneLine(const std::string& message);

// Whether printing a message has failed.
bool MessageFailed();

}  // namespace penumbra
