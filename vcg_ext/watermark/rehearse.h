// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../attack/attack.h"
#include "../key/key.h"
#include "../method/marking.h"
#include "../payload/message_text.h"

namespace vcg_ext {

/// One attack of a rehearsal, and what detection said after it.
struct Rehearsal {
    const char* name; ///< "noise .1 %"
    AttackOptions attack;
    double p_value = 1; ///< of the message; 1 too where the attack is none for this mesh
    bool present = false;
};

/// Tries on copies what users do to meshes, and whether the mark is still read: noise .1 %, simplification to half,
/// five rounds of smoothing, quantization to 9 bits.
///
/// \param marked   the stego mesh
/// \param carriers as it was marked
/// \throw Cancelled where `progress` returned false
[[nodiscard]] std::vector<Rehearsal> rehearse(const Surface& marked, const Key& key, const CarrierOptions& carriers,
                                              const Message& message, const Progress& progress = {});

/// "survives noise .1 % (p 1e-30); is lost by smoothing .5 x 5."
[[nodiscard]] std::string summary(const std::vector<Rehearsal>& rehearsals);

} // namespace vcg_ext
