# SPDX-License-Identifier: GPL-3.0-or-later
"""A marked copy of each model for each recipient, and the ledger that says whose is which."""

from .ledger import Ledger
from .plan import Order
from .run import Outcome, forecast, make_copies

__all__ = ["Ledger", "Order", "Outcome", "forecast", "make_copies"]
