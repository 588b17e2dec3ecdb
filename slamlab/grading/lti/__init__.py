"""LTI Advantage's services, as a client: names and roles, and grades sent back. Nothing listens.

1EdTech: Names and Role Provisioning Services 2.0, Assignment and Grade Services 2.0, Security
Framework 1.0. Needs the extra ``lti``; tried against a platform made up for the tests alone.

Read in this order:

- ``settings``: what the course file says of the LMS
- ``keys``: by which the LMS knows this program
- ``service``: a token by a signed assertion, and bounded requests to one origin
- ``names_and_roles``, ``grade_passback``: the two services
"""
