/// A CB6 infrared button box, or switches at the digital inputs, of a Display++ or Bits#: through the box's
/// status stream, whose samples carry its clock.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "devices/display_box/display_plus_plus.h"
#include "experiment/ports/button_box.h"
#include "experiment/ports/clock.h"

namespace overt {

/// Buttons 1 to 6 are A to F of a CB6; 7 to 16 are the digital inputs Din0 to Din9.
class Cb6Box final : public ButtonBox {
  public:
    /// Starts the status stream, see begin(). `box` is the session's and must outlive this; while this is
    /// used, nobody else takes samples from it.
    explicit Cb6Box(DisplayPlusPlus& box, Clock& clock);
    /// Ends the stream, without throwing.
    ~Cb6Box() override;
    Cb6Box(const Cb6Box&) = delete;
    Cb6Box& operator=(const Cb6Box&) = delete;

    ButtonBoxDescription description() const override;
    std::string button_name(int button) const override;
    void begin() override;
    std::size_t poll(std::span<ButtonChange> into) noexcept override;
    bool lost() const noexcept override { return box_->lost(); }

  private:
    void keep(const BoxEvent& event) noexcept;

    DisplayPlusPlus* box_;
    Clock* clock_;
    std::optional<BoxClockMap> map_;
    BoxEdgeDetector edges_;
    std::array<ButtonChange, BoxEdgeDetector::most_events> held_{}; ///< of one sample
    std::size_t held_count_ = 0, given_ = 0;
};

} // namespace overt
