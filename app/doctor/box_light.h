/// A response box as a sensor of light: its own light sensor, or one across a button, tells the edges.
#pragma once

#include <memory>
#include <vector>

#include "devices/buttons/threaded_button_box.h"
#include "devices/light/light_sensor.h"

namespace overt {

/// What a box told besides its edges.
struct BoxWords {
    ButtonBoxDescription description;
    SessionDuration worst_uncertainty{}; ///< that it gave with a time
    bool is_lost = false;                ///< the box went meanwhile
};

/// A button that goes down is light, one that goes up is dark. On one thread.
class BoxLightSensor final : public LightSensor {
  public:
    /// `words` must outlive this. Throws DeviceError if the box does not answer.
    BoxLightSensor(std::unique_ptr<ThreadedButtonBox> box, BoxWords& words);
    void shown(const LightEdge&) override { take(); }
    std::vector<LightEdge> edges() override;

  private:
    void take();

    std::unique_ptr<ThreadedButtonBox> box_;
    BoxWords& words_;
    std::vector<LightEdge> edges_;
};

} // namespace overt
