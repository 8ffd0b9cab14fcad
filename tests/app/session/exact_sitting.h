/// A session with a tracker without errors, put together of the program's own parts.
#pragma once

#include "app/inputs/protocol_inputs.h"
#include "app/record/recorded_surface.h"
#include "app/session/session_recording.h"
#include "devices/host/clocks.h"
#include "devices/simulated/simulated_eye_tracker.h"
#include "devices/simulated/simulated_keys.h"
#include "devices/simulated/simulated_response_panel.h"
#include "experiment/design/schedule.h"
#include "experiment/record/tables/table_export.h"
#include "experiment/record/write/session_store.h"
#include "experiment/session/session.h"
#include "render/gl/headless_context.h"
#include "render/presenter/stereo_presenter.h"
#include "render/vblank/display_surface.h"
#include "tests/app/small_experiment.h"

namespace overt::test {

inline ObserverSettings steady_eyes() {
    ObserverSettings settings;
    settings.drift = settings.tremor = Degrees{0.0};
    return settings;
}

inline SimulatedTrackerSettings without_errors(const TrackerSettings& settings) {
    SimulatedTrackerSettings exact = simulated_tracker_settings(settings);
    exact.noise_deg = exact.accuracy_deg = exact.steps_per_px = 0.0;
    return exact;
}

/// The program's own parts, put together as its rig does, with perfect devices whose truth can be asked for.
class ExactSitting {
  public:
    explicit ExactSitting(std::string_view text = small_protocol) : files(text) {}

    SmallExperiment files;
    Diagnostics diagnostics;
    Experiment experiment =
        read_experiment(files.protocol(), files.cache(), InputDepth::everything, diagnostics).value();
    const Protocol& protocol = experiment.protocol;
    Schedule schedule = make_schedule(protocol, {"P01", 1}, 11);
    std::unique_ptr<GlContext> context = make_headless_context(ContextKind::osmesa);
    StimulusLibrary library{*context, protocol, experiment.objects, files.cache()};
    ScreenGeometry geometry = screen_geometry_of(protocol);
    VirtualClock clock;
    VirtualDisplay display{*context, clock, protocol.display.refresh_hz};
    std::unique_ptr<Presenter> presenter = make_presenter();
    SimulatedObserver observer{make_observed_scene(protocol, experiment.objects, geometry), 3, steady_eyes()};
    SimulatedEyeTracker tracker{clock, observer, 3, without_errors(protocol.tracker)};
    SimulatedAnswers answers{protocol, 3};
    SimulatedResponsePanel panel{clock, observer, {}, &answers};

    std::filesystem::path folder; ///< of the session, once it has run

    std::unique_ptr<Presenter> make_presenter() {
        if (protocol.stereo.is_on())
            return std::make_unique<StereoPresenter>(*context, display, library, protocol);
        return std::make_unique<PagePresenter>(*context, display, library, geometry, protocol.display,
                                               protocol.screens, slot_places(protocol));
    }

    /// Runs all trials and exports them; gives the export's folder.
    std::filesystem::path run() {
        library.maps().prepare_maps({});
        library.prepare_frames({}, BakeQuality::live);
        const SessionHeader header =
            make_session_header(protocol, schedule, experiment.objects, library, context->description(),
                                tracker.description(), ClockKind::virtual_time, true);
        SessionDirectory directory({files.sessions(), protocol.name, "P01"});
        put_files(directory, header, experiment.objects, library);
        directory.publish();
        SessionStore store(directory.session_file(),
                           {.wait_when_full = true,
                            .started_utc = header.started_utc,
                            .detection = SittingDetection{protocol.events, geometry}});
        Session sitting(protocol, schedule, geometry.centre(),
                        {clock, *presenter, tracker, panel, store, {&observer}});
        sitting.run({});
        store.close();

        folder = directory.path();
        const SessionRecord record(folder);
        RecordedSurfaces surfaces(record);
        std::filesystem::path tables = files.folder().path() / "tables";
        export_tables(
            record, [&](const ViewedObject& viewed) { return surfaces.lookup_of(viewed); }, tables);
        return tables;
    }
};

} // namespace overt::test
