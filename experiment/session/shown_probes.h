/// Marks at places of the surface, which follow it from frame to frame, and the gauge that is set at one.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiment/answers/answering.h"
#include "experiment/design/trial_plan.h"
#include "experiment/ports/presenter.h"
#include "experiment/ports/probe_view.h"
#include "experiment/ports/trial_outcome.h"

namespace overt {

struct SessionPorts;

/// Of the trial that runs.
class ShownProbes {
  public:
    /// Both must outlive this.
    ShownProbes(const Protocol& protocol, const SessionPorts& ports);

    /// Finds where the trial's places are seen. May take some milliseconds: before anything is shown.
    void begin_trial(const Trial& trial);
    /// A show begins, as the `number`-th of the attempt's steps, from 1; `first`: the frame that each of what
    /// the trial shows begins with. Adds a row for each probe that it shows.
    void begin_show(const PlannedStep& step, int number, std::span<const AnimationFrameIndex> first,
                    std::vector<ShownProbe>& rows);
    /// What the next flip shows, of all that the trial shows, and the gauge that is set meanwhile, or null.
    /// Allocates and throws nothing.
    void before_flip(std::span<const AnimationFrameIndex> frames, const Answering* gauge,
                     std::vector<ShownProbe>& rows) noexcept;

    /// The surface where a probe stands, in the frame flipped last, or that a show begins with; nothing where
    /// nobody knows.
    std::optional<Attitude> truth_at(std::string_view probe) const noexcept;
    /// Adds to what was set with gauges what was lit then.
    void complete(std::vector<GivenAnswer>& given) const;

  private:
    struct Probe {
        const ProbeSettings* settings = nullptr;
        std::string point;
        int place = 0; ///< in Trial::shown
        std::shared_ptr<const ProbeView> view;
        SeenProbe seen = {};
        AnimationFrameIndex frame{-1}; ///< of `seen`; negative: its stimulus is not lit
        StimulusMark mark = {};        ///< with its size and light; where it stands comes with each flip
        int row = -1;                  ///< in the attempt's; -1: this step does not show it
    };
    /// The flip before a gauge was set for the last time.
    struct SetGauge {
        std::string answer;
        std::size_t probe = 0;
        SeenProbe seen = {};
        AnimationFrameIndex frame{-1};
        bool is_known = false;
    };
    const Probe* find(std::string_view id) const noexcept;
    void see(Probe& probe, std::span<const AnimationFrameIndex> frames) const noexcept;
    void add_gauge(const Answering& gauge) noexcept;
    void add_mark(const StimulusMark& mark, const StimulusMark& of_other_eye) noexcept;
    void show_marks() const noexcept;

    const Protocol& protocol_;
    const SessionPorts& ports_;
    double px_per_deg_;
    std::vector<Probe> probes_;
    std::vector<SetGauge> gauges_;                                       ///< of all gauges of the task
    std::array<StimulusMark, Presenter::most_marks> marks_{}, others_{}; ///< as each eye has them
    std::size_t mark_count_ = 0;
    bool has_marked_ = false; ///< the presenter has marks
};

} // namespace overt
