# %% [markdown] slideshow={"slide_type": "slide"}
# # Glossary
#
# This appendix lists the terms of the field that the lessons teach. Each row contains a term with its
# synonyms, its meaning in one sentence, the file of the project that implements it, and the lessons
# that teach it.
#
# Overview of the course: [Start here](00_start_here.ipynb). Symbols: [Notation](notation.ipynb).

# %% [markdown] slideshow={"slide_type": "skip"} name="glossary"
# {{glossary}}
