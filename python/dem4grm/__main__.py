# SPDX-License-Identifier: BSD-3-Clause
"""`python3 -m dem4grm`: the command line, with the verbs that only the package has."""
from .program import main

main()
