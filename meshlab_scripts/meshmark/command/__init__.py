# SPDX-License-Identifier: GPL-3.0-or-later
"""The command `meshmark`: a file a group of subcommands."""
