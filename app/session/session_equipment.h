/// What a session uses of the machine.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/interruption.h"
#include "app/rig/answer_equipment.h"
#include "app/rig/marker_outputs.h"
#include "app/rig/rig.h"
#include "app/rig/sounds.h"
#include "app/session/session_boxes.h"
#include "app/session/session_plan.h"

namespace overt {

/// Display, stimuli, tracker, boxes, outputs of markers and sound, ready for a session. Ends in the opposite
/// order. Main thread.
class SessionEquipment {
  public:
    /// Opens the display, prepares the stimuli, sees that the disk has room, and opens the rest; says on the
    /// terminal what it finds. Everything but `cache` must outlive this. Throws InputError for what this
    /// machine cannot do, and GraphicsError, DeviceError or RecordError for what it refuses.
    SessionEquipment(const Experiment& experiment, const RunOptions& options, const SessionPlan& plan,
                     const std::filesystem::path& cache);

    Rig& rig() { return rig_; }
    BoxInUse& box() { return *box_; }
    /// Where observer and operator answer: the response boxes with what they stand around, or that alone.
    ResponsePanel& keys() { return buttons_ ? *buttons_ : rig_.panel(); }
    const MarkerEquipment& markers() const { return *markers_; }
    Sounds& sounds() { return *sounds_; }
    AnswerEquipment& answers() { return *answers_; }
    /// What the operator should know once the session has ended, a line each.
    std::vector<std::string> closing_warnings() const;

  private:
    void prepare(const Experiment& experiment, const RunOptions& options, const SessionPlan& plan);
    void open(const Protocol& protocol, const RunOptions& options, const SessionPlan& plan);

    FoundBox found_box_;
    Rig rig_;
    std::optional<Interruption> interruption_;
    std::optional<BoxInUse> box_;
    std::unique_ptr<ResponsePanel> buttons_; ///< null: there are no response boxes
    std::optional<MarkerEquipment> markers_;
    std::optional<Sounds> sounds_;
    std::unique_ptr<AnswerEquipment> answers_;
};

} // namespace overt
