// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "error.h"

#include <functional>

namespace vcg_ext {

/// Thrown where the progress callback asked to stop. The caller's surface is as it was.
class Cancelled : public Error {
public:
    Cancelled() : Error("Cancelled; the mesh is unchanged.") {}
};

/// Progress callback: percent done (0 to 100) and the name of the phase. Returns false to cancel.
using Progress = std::function<bool(int percent, const char* phase)>;

/// Calls `progress`, where there is one, and throws Cancelled where it says so.
inline void report(const Progress& progress, int percent, const char* phase)
{
    if (progress && !progress(percent, phase))
        throw Cancelled();
}

/// The progress of a part: its 0 to 100 percent are `from` to `to` of the whole, under the whole's own name of the
/// phase where one is given.
/// \param whole must outlive the result
inline Progress within(const Progress& whole, int from, int to, const char* name = nullptr)
{
    if (!whole)
        return {};
    return [&whole, from, to, name](int percent, const char* phase) {
        return whole(from + percent * (to - from) / 100, name ? name : phase);
    };
}

} // namespace vcg_ext
