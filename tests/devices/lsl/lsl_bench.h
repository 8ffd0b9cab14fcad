/// The stand-in for liblsl, loaded as the program loads the real one.
#pragma once

#include <memory>
#include <string>

#include "devices/host/clocks.h"
#include "devices/link/shared_library.h"
#include "tests/devices/lsl/fake_liblsl.h"

namespace overt::test {

/// Begins with an empty network.
class LslBench {
  public:
    LslBench() {
        FakeLsl* (*find)() = nullptr;
        const SharedLibrary library({OVERT_FAKE_LIBLSL}, "the stand-in", "");
        library.find(find, "fake_lsl");
        fake_ = find();
        const std::scoped_lock lock(fake_->mutex);
        fake_->network.clear();
        fake_->sent.clear();
        fake_->asked.clear();
        fake_->refused.clear();
    }

    SteadyClock clock;
    static std::string library() { return OVERT_FAKE_LIBLSL; }
    FakeLsl& fake() const { return *fake_; }

    /// A stream of a tracker of both eyes, such as a relay sends: x and y of each eye as shares of the
    /// screen, confidence, and each pupil in mm.
    std::shared_ptr<FakeStream> add_gaze(const std::string& name) const {
        auto stream = std::make_shared<FakeStream>();
        stream->name = name;
        stream->type = "Gaze";
        stream->source = "serial 7";
        for (const char* eye : {"left", "right"}) {
            stream->add_channel(std::string(eye) + "_x", eye, "ScreenX", "normalized");
            stream->add_channel(std::string(eye) + "_y", eye, "ScreenY", "normalized");
            stream->add_channel(std::string(eye) + "_pupil", eye, "Diameter", "mm");
        }
        stream->add_channel("confidence", "both", "Confidence", "");
        const std::scoped_lock lock(fake_->mutex);
        fake_->network.push_back(stream);
        return stream;
    }

  private:
    FakeLsl* fake_ = nullptr;
};

} // namespace overt::test
