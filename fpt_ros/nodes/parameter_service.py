"""The services of parameters, which answer what rclpy's do not.

A value of a type that there is not leaves who set it without an answer. An empty list comes as one
of bytes, from rclpy and ``ros2 param set`` alike: of a list of another type it is refused.
"""

from collections.abc import Sequence

from rcl_interfaces.msg import Parameter, SetParametersResult
from rcl_interfaces.srv import SetParameters, SetParametersAtomically
from rclpy.parameter import Parameter as RosParameter
from rclpy.parameter_service import ParameterService

BYTES = RosParameter.Type.BYTE_ARRAY.value


class AnsweringParameterService(ParameterService):
    """rclpy's, with a reason for what it cannot read, and empty lists for all lists."""

    def _set_parameters_callback(
        self, request: SetParameters.Request, response: SetParameters.Response
    ) -> SetParameters.Response:
        for each in request.parameters:
            refused = self._look_at([each])
            if refused is None:
                one = SetParameters.Request(parameters=[each])
                super()._set_parameters_callback(one, response)
            else:
                response.results.append(refused)
        return response

    def _set_parameters_atomically_callback(
        self, request: SetParametersAtomically.Request, response: SetParametersAtomically.Response
    ) -> SetParametersAtomically.Response:
        refused = self._look_at(request.parameters)
        if refused is None:
            return super()._set_parameters_atomically_callback(request, response)
        response.result = refused
        return response

    def _look_at(self, parameters: Sequence[Parameter]) -> SetParametersResult | None:
        """Give empty lists their type; why these cannot be read, ``None``: they can."""
        node = self._get_node()
        for each in parameters:
            if each.value.type == BYTES and not each.value.byte_array_value:
                declared = node.has_parameter(each.name) and node.describe_parameter(each.name).type
                each.value.type = max(declared, BYTES)
            try:
                RosParameter.from_parameter_msg(each)
            except ValueError as error:
                reason = f"{each.name}: a value that cannot be read: {error}"
                return SetParametersResult(successful=False, reason=reason)
        return None
