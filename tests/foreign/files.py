"""Workbooks that are kept as files, each of a kind that was once answered wrongly.

They were made by scripts; the base is a right sheet of the scheme with 0.5 ns. `lo-saved-*` were
calculated and saved by LibreOffice 7.4, so that their stored values are its own.
"""

from pathlib import Path

from foreign.truth import CLEAN, Truth, fault, refused

FOLDER = Path(__file__).with_name("cases")

ANOTHER_MODEL = refused("another model")

FILES: dict[str, Truth] = {
    # a thrown ball with linear drag, explicit Euler: a 5 kg sphere of 11 µm is not a particle
    "m-projectile": ANOTHER_MODEL,
    # a ball that falls from rest: in a sentence with a subject and a cell
    "m-falling-linear": ANOTHER_MODEL,
    # v_i = B14:B66, and =v_i-a_*dt_ takes its own row: Excel without dynamic arrays, LibreOffice
    "names-of-columns": CLEAN,
    "lo-saved-one-name-cell": CLEAN,  # one cell J20 =v_i*3.6
    "whole-column-name-4": CLEAN,
    "wc-normalised": CLEAN,  # 131 times =C15/MAX(C:C)
    "relative-name-beside": CLEAN,  # names with relative references, Model!$B1 seen from A1
    "lo-saved-relative-name-beside": CLEAN,
    # Differences and MOD of nearly equal numbers, which Excel and LibreOffice store as 0: neither
    # that nor the exact value is a fault.
    "snap-to-zero": CLEAN,
    "control-cells": CLEAN,
    "time-check-column": CLEAN,
    "mod": CLEAN,
    "lo-saved-snap-to-zero": CLEAN,
    "lo-saved-time-check-column": CLEAN,
    "lo-saved-mod": CLEAN,
    "lo-saved-thin-mod": CLEAN,
    # SUBTOTAL with hidden rows
    "subtotal-hidden": CLEAN,
    "subtotal104-depth": CLEAN,
    "lo-saved-subtotal104-depth": CLEAN,
    "precision-as-displayed": CLEAN,  # the setting is named
    # numbers stored as text: 1,1E-5 and 8,900 and 7 850
    "text-comma": fault("typed number", "B1"),
    "text-thousands": fault("typed number", "B2"),
    "text-space": fault("typed number", "B3"),
    "table-linebreak-heads": CLEAN,  # an Excel table whose heads have line breaks
    "shared-yld1": CLEAN,  # shared formulas that use the name Yld1
    "shared-orphans": refused("D66", "no first cell"),  # the formulas that D17 to D66 share
    "z-sharedstrings-case": CLEAN,  # xl/SharedStrings.xml in another case
}
