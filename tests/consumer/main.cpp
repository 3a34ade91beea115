// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>
#include <vcg_ext/base/error.h>
#include <vcg_ext/base/version.h>
#include <vcg_ext/watermark/watermark.h>

int main()
try {
    const vcg_ext::DetectReport report = vcg_ext::detect({}, vcg_ext::Key("a key"), {});
    std::printf("%zu bits from a mesh without faces\n", report.bits.size());
    return 1;
} catch (const vcg_ext::Error& error) {
    std::printf("vcg_ext %s: %s\n", VCG_EXT_VERSION, error.what());
}
