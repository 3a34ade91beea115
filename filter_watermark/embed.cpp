// SPDX-License-Identifier: GPL-3.0-or-later
#include <vcg_ext/base/progress.h>
#include <vcg_ext/carrier/statistic.h>

#include <algorithm>
#include <optional>

#include "corner_data.h"
#include "layer.h"
#include "report.h"
#include "shared_parameters.h"

namespace {

QString info()
{
    return "Hides a message in the shape of the mesh, so that it cannot be seen. <b>Watermark: Detect</b> reads it back "
           "with the key alone, also after noise, smoothing, simplification, remeshing, quantization, rotation, "
           "translation and uniform scale.<br>"
           "Only positions change, whatever is selected; colours, texture and quality stay where they were on the "
           "surface, and seams closed. The filter ends with a blind detection, and fails, with the mesh unchanged, "
           "where a bit would not read back.<br>"
           "Keep the key secret, and note the recipe that the log ends with: detection needs it. <b>Certificate</b> names a "
           "file of some 25 kB with what <b>Watermark: Detect with Original</b> needs of the original, for Waves, Layered and "
           "the methods of vertex norms. The key is not in it, but the shape is: keep it as you would the original.<br>" +
           about_carrier_parameters() +
           "See <i>M. Luo, A. G. Bors</i>, Surface-preserving robust watermarking of 3-D shapes, IEEE Trans. Image "
           "Processing, 2011; <i>J.-W. Cho, R. Prost, H.-Y. Jung</i>, IEEE Trans. Signal Processing, 2007.";
}

RichParameterList parameters(const MeshDocument&)
{
    RichParameterList list;
    list.addParam(RichString("Message", "", "Message",
                             "Plain text (up to 64 letters), id:17 (a number), hex:C0FFEE, or bits:0110 (raw)."));
    add_carrier_parameters(list, "0 (usual) takes as many carriers as the message needs to last; or 1 to 1024.");
    list.addParam(RichFloat("Strength", 0, "Strength",
                            "0 is usual: 1e-4 of the diagonal (Layered, Waves), 15 (Spectral), 0.1 (the others)."));
    list.addParam(RichBool("Rehearse", false, "Rehearse",
                           "Tries noise, simplification, smoothing, quantization on copies; says what it survives."));
    list.addParam(
        RichFileSave("Certificate", "", "*.wmc", "Certificate",
                     "File for Watermark: Detect with Original where the original cannot be kept; or empty."));
    add_report_parameter(list);
    return list;
}

/// embed(); where the mesh cannot carry so many bits, the error says how many it can.
vcg_ext::EmbedReport embed_or_advise(vcg_ext::Surface& surface, const vcg_ext::Key& key,
                                     const vcg_ext::EmbedOptions& options, const vcg_ext::Progress& progress)
{
    try {
        return embed(surface, key, options, progress);
    } catch (const vcg_ext::DoesNotFit& cause) {
        const int fits = carriers_that_fit(surface, key, options, cause, progress);
        const std::string advice =
            fits > 0 ? " This mesh carries " + std::to_string(fits) +
                           " bits with this method and key: set Bits to that, or use a finer mesh."
                     : std::string(" Other numbers did not fit either: use another method, or a finer mesh.");
        throw vcg_ext::Error(cause.what() + advice);
    }
}

/// Vertices that stay, so that the texture is not stretched where they could only slide along a seam: those on seams,
/// unless these are so many that little would be left to carry a mark.
std::vector<char> seams_to_hold(const vcg_ext::Surface& surface, const vcg_ext::CornerValues& shown)
{
    constexpr double most = 0.3; // of the vertices
    std::vector<char> held = on_seams(surface, shown);
    if (double(std::count(held.begin(), held.end(), 1)) > most * double(held.size()))
        held.clear();
    return held;
}

Json run(const RichParameterList& values, MeshDocument& document, const vcg_ext::Progress& progress)
{
    MeshModel& layer = current_layer_or_error(document);
    vcg_ext::EmbedOptions options;
    options.carriers = read_carrier_options(values);
    options.message = vcg_ext::read_message(read_text(values, "Message"));
    options.placement.strength = read_number(values, "Strength");
    options.placement.storage = sizeof(Scalarm) == sizeof(float) ? vcg_ext::Storage::Float : vcg_ext::Storage::Double;
    const vcg_ext::Key key = read_key(values);
    OutputFile certificate(values, "Certificate");
    ReportFile file(values);

    const bool stretched = is_stretched(layer);
    vcg_ext::Surface surface = read_surface(layer);
    const vcg_ext::CornerValues shown = read_corner_values(layer);
    if (has_texture(layer))
        options.held = seams_to_hold(surface, shown);
    std::string certified;
    if (certificate.wanted())
        certified = bytes_of(make_certificate(surface, key, options));
    const bool rehearses = values.getBool("Rehearse");
    const vcg_ext::EmbedReport embedded =
        embed_or_advise(surface, key, options, vcg_ext::within(progress, 0, rehearses ? 50 : 100));
    std::vector<vcg_ext::Rehearsal> rehearsals;
    if (rehearses) {
        options.carriers.bits = embedded.carriers;
        rehearsals = rehearse(surface, key, options.carriers, options.message, vcg_ext::within(progress, 50, 100));
    }
    Json report = to_json(embedded, rehearsals);
    std::optional<vcg_ext::CarriedValues> carried;
    if (shown.channels > 0)
        carried = carried_values(read_surface(layer), shown, surface.points);
    if (carried && has_texture(layer))
        report["texture_stretch"] = carried->stretch;
    if (stretched)
        report["warnings"].push_back(stretched_as_written);
    if (const std::string others = about_other_layers(document, "carries the mark"); !others.empty())
        report["warnings"].push_back(others);
    NormalShares shares(layer.cm.vert.size());
    certificate.write(certified);
    file.write(report); // the last that can fail
    write_positions(layer, surface.points, shares);
    if (carried)
        write_corner_values(layer, carried->values);
    return report;
}

} // namespace

const Filter embed_filter = {"Watermark: Embed",
                             "apply_coord_watermark",
                             HostInterface::Smoothing,
                             HostInterface::SINGLE_MESH,
                             MeshModel::MM_VERTCOORD | MeshModel::MM_VERTNORMAL | MeshModel::MM_FACENORMAL |
                                 MeshModel::MM_TRANSFMATRIX | MeshModel::MM_VERTCOLOR | MeshModel::MM_VERTQUALITY |
                                 MeshModel::MM_VERTTEXCOORD | MeshModel::MM_WEDGTEXCOORD,
                             info,
                             parameters,
                             run};
