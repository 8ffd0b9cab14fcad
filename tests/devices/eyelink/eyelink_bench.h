/// What tests of the EyeLink share.
#pragma once

#include "devices/host/clocks.h"
#include "tests/support/diary_setup_screen.h"
#include "tests/support/kept_items.h"
#include "tests/support/stand_in_library.h"

namespace overt::test {

/// Today's stand-in, or a variant of it.
class StandIn : public StandInLibrary {
  public:
    explicit StandIn(std::string file = OVERT_STAND_IN_EYELINK) : StandInLibrary(std::move(file)) {}
};

} // namespace overt::test
