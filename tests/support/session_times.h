/// Times of a session in seconds, as tests write them.
#pragma once

#include "experiment/session_time.h"

namespace overt::test {

inline SessionTime at_s(double seconds) { return SessionTime(from_seconds(seconds)); }

} // namespace overt::test
