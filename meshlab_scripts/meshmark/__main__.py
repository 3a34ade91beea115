# SPDX-License-Identifier: GPL-3.0-or-later
"""`python -m meshmark` is the command."""

from .command.app import main

main()
