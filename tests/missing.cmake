# SPDX-License-Identifier: GPL-3.0-or-later
# What a suite says that cannot run.
message(FATAL_ERROR "This needs ${MISSING}. Run meshlab_scripts/setup.sh, then configure and build again: tests/run.sh does all of it.")
