// SPDX-License-Identifier: GPL-3.0-or-later
#include "pieces.h"

#include "../base/error.h"
#include "../base/text.h"

namespace vcg_ext {

namespace {

constexpr int most = 16;
constexpr double least = 0.01; ///< of the area

/// Whether it was read at all: what is no copy of an original was not.
bool was_read(const DetectReport& report)
{
    return !report.registration || report.registration->found;
}

PartReport told(const Part& piece, const DetectReport& found)
{
    PartReport report;
    report.vertices = static_cast<int>(piece.surface.points.size());
    report.area_share = piece.area_share;
    report.registration = found.registration;
    report.p_value = found.p_value;
    report.p_message = found.p_message;
    report.verdict = found.verdict;
    return report;
}

} // namespace

std::vector<Part> pieces_to_look_at(const Surface& surface)
{
    std::vector<Part> pieces = connected_parts(surface, most, least);
    if (pieces.size() == 1)
        pieces.clear();
    return pieces;
}

void look_at_pieces(const PieceReader& read, const std::vector<Part>& pieces, DetectReport& result,
                    const Progress& progress)
{
    const int count = static_cast<int>(pieces.size());
    std::vector<PartReport> reports;
    for (int i = 0; i < count; ++i) {
        const Part& piece = pieces[i];
        DetectReport found;
        try {
            found = read(piece.surface, 0.5 / count, within(progress, 100 * i / count, 100 * (i + 1) / count));
        } catch (const Cancelled&) {
            throw;
        } catch (const Error& error) { // a piece that can carry nothing
            found.verdict = error.what();
            reports.push_back(told(piece, found));
            continue;
        }
        reports.push_back(told(piece, found));
        if (!was_read(found) || (was_read(result) && !says_more(found, result)))
            continue;
        found.verdict = "part " + std::to_string(i + 1) + " of " + std::to_string(count) + " (" +
                        percent(piece.area_share) + " of the area): " + found.verdict;
        for (const auto& [phase, seconds] : result.seconds)
            found.seconds[phase] += seconds;
        found.carrier_of_vertex.clear(); // vertices of the piece, not of the mesh
        result = std::move(found);
    }
    result.parts = std::move(reports);
}

} // namespace vcg_ext
