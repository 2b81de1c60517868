// apps/messages.h
//
// What users are told on standard error.

#pragma once

#include <string>

namespace penumbra {

// One line: control characters and what is no UTF-8 are escaped, for names in files may hold anything, and a
// very long one loses its middle. Whatever becomes of it, the work goes on.
void Say(const std::string& message);

// Lines as they are.
void SayAsItIs(const std::string& text);

// `message` as Say() says it, without the end of the line.
std::string OneLine(const std::string& message);

// Whether something could not be said.
bool WasUnheard();

}  // namespace penumbra
