#include "experiment/table_columns.h"

#include <fmt/format.h>

namespace overt {

bool is_column_of_tables(std::string_view name) {
    // Of trials, samples, answers, places and movements, and of BIDS's events.
    constexpr std::string_view names =
        " accepted along answered_s elevation_deg t_s changes correct_answer deviation_deg drawn_by "
        "drift_deg end_deg "
        "end_elevation_deg error first_input_s frames_sha256 gaze_share high id image_x_px image_y_px "
        "incidence_deg is_correct item key longest_delay_s lost_flips lost_samples low "
        "made_from_sha256 mapping median_delay_s mesh_file mesh_sha256 missed_refreshes mm_per_unit "
        "net_deg number origin_x origin_y origin_z p_object path_deg place point_frame "
        "point_image_x_px point_image_y_px point_incidence_deg point_part point_sd_major "
        "point_sd_minor point_slot point_triangle point_x point_y point_z poses presentation_end_s "
        "presentation_onset_s pupil_size reference responded_s response response_box response_id "
        "response_key response_number response_screen_onset_s response_time response_time_s "
        "response_uncertainty_s reversals role samples_off_plan samples_on_object "
        "samples_without_gaze screen_onset_s second_setting second_setting_reference "
        "second_setting_start seen setting setting_reference setting_start shown_refreshes shown_s "
        "shown_size silhouette_distance_deg slant_deg start start_deg start_elevation_deg started_s "
        "stimulus_onset_s stopped_high stopped_low surface_x surface_y surface_z surface_files "
        "surface_sha256 swaps_copied "
        "swaps_flipped swaps_skipped swaps_suboptimal_copied task_screen_onset_s tied tilt_deg time_s "
        "time_uncertainty_s tracker_onset tracker_time_us triangle true_slant_deg true_tilt_deg "
        "turning_s uncertainty_s window_end_s window_onset_s zero ";
    return names.find(fmt::format(" {} ", name)) != std::string_view::npos;
}

} // namespace overt
