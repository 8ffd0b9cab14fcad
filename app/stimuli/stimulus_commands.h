/// The commands for looking at stimuli and making them: play, pick-head, paint-areas, bake, lut, reconstruct.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "app/cli/chosen_command.h"
#include "app/cli/context_choice.h"
#include "experiment/protocol/protocol.h"

namespace overt {

void add_stimulus_commands(CLI::App& app, ChosenCommand& chosen);

struct PlayOptions {
    std::filesystem::path protocol;
    std::string stimulus;
    ContextChoice context;
    std::optional<int> frame;
    std::filesystem::path picture;
    double repeat_s = 8.0;
    bool live = false; ///< drawn now, to be turned with the mouse, instead of the frames
};
int run_play(const PlayOptions& options);

struct PickHeadOptions {
    std::filesystem::path mesh;
    std::string up, unit; ///< as [[object]] has them; empty: as is usual for the file's format
    // A head to begin with, in the file's coordinates.
    std::vector<std::array<double, 4>> spheres; ///< x, y, z, radius
    std::vector<std::array<double, 6>> planes;  ///< a point, and the direction in which the head lies
    std::filesystem::path picture;              ///< empty: a window
    double turn_deg = 0.0;                      ///< of the picture
    ContextChoice context;
};
/// Prints the key `head` of an object. Throws InputError, GraphicsError, RecordError.
int run_pick_head(const PickHeadOptions& options);

struct PaintAreasOptions {
    std::filesystem::path mesh;
    std::string up, unit;           ///< as [[object]] has them; empty: as is usual for the file's format
    std::vector<std::string> areas; ///< names, beside those that the mesh has
    std::filesystem::path labels;   ///< to go on with; empty: the labels of the mesh file
    std::filesystem::path out;      ///< empty: beside the mesh
    /// Painted before anything else: an area, and a place and a radius in the file's coordinates.
    std::vector<std::tuple<std::string, double, double, double, double>> dabs;
    std::vector<std::string> mirrored; ///< areas that are then painted alike on the other side
    std::filesystem::path picture;     ///< empty: a window, unless something is painted already
    double turn_deg = 0.0;             ///< of the picture
    bool overwrite = false;
    ContextChoice context;
};
/// Writes a file of labels of a mesh. Throws InputError, GraphicsError, RecordError.
int run_paint_areas(const PaintAreasOptions& options);

struct BakeOptions {
    std::filesystem::path protocol;
    std::optional<BakeQuality>
        quality; ///< nothing: the protocol's, if it is better than a preview, else standard
    std::optional<int> samples;
    std::optional<double> target_error_de;
    std::vector<std::string> only; ///< OBJECT/MATERIAL; empty: all that are not given as frames
    std::string frames = "all";    ///< "7", "0-30"
    std::string shard;             ///< "1/4"
    std::filesystem::path out;     ///< folder for numbered frames, or empty
    std::string as = "display";    ///< or xyz, spectra
    bool png16 = false;
    bool half = false;
    bool force = false;
    std::filesystem::path sheet, strip; ///< pictures to look at, or empty
    bool dry_run = false;
    bool json = false;
    ContextChoice context;
};
int run_bake(const BakeOptions& options);

struct LutOptions {
    std::filesystem::path protocol;
    std::string stimulus;        ///< OBJECT or OBJECT/MATERIAL: the map is the same for all materials
    bool through = false;        ///< of what is seen through its glass, instead of the front
    std::optional<int> frame;    ///< nothing: all
    std::filesystem::path out;   ///< folder; empty: luts/OBJECT, or with `check` nothing is written
    std::string format = "both"; ///< exr, png16 or both
    int scale = 65535;           ///< of 16-bit codes, or 65536
    ContextChoice context;
    bool check = false;
    bool overwrite = false;
    bool json = false;
};
int run_lut(const LutOptions& options);

struct ReconstructOptions {
    std::filesystem::path protocol;
    std::string stimulus;      ///< OBJECT or OBJECT/MATERIAL
    std::optional<int> frame;  ///< nothing: all
    bool points = false;       ///< a cloud also of one frame
    double spacing = 0.0;      ///< of a cloud's points, in the unit of the mesh; 0: as the pixels have it
    std::filesystem::path out; ///< .ply or .obj
    ContextChoice context;
    bool overwrite = false;
    bool json = false;
};
int run_reconstruct(const ReconstructOptions& options);

} // namespace overt
